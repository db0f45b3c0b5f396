#include "render/brick_source.h"

namespace quincunx {
namespace {

IndexBox slot_box(const BrickLayout& layout, const glm::ivec3& brick) { return {layout.first_index(brick), Extents(layout.samples)}; }

}  // namespace

void CoefficientBricks::fill(const glm::ivec3& brick, std::span<float> slot) const {
  copy_box(coefficients_, slot_box(layout_, brick), slot);
}

void SampleBricks::fill(const glm::ivec3& brick, std::span<float> slot) const {
  box_coefficients(source_, spline_, prefilter_, unit_, slot_box(layout_, brick), slot);
}

}  // namespace quincunx

#include "spline/box_coefficients.h"

#include <algorithm>
#include <cassert>

namespace quincunx {
namespace {

/// Copies `box`, clamped to a volume of `extents`, from the part of it that begins at index `begin`.
void copy_clamped(const Coefficients<float>& part, const glm::i64vec3& begin, const Extents& extents, const IndexBox& box,
                  std::span<float> out) {
  assert(std::int64_t(out.size()) == coset_count(part.lattice) * box.size.x * box.size.y * box.size.z);
  const glm::i64vec3 last = extents - std::int64_t(1);
  const std::int64_t x0 = std::clamp<std::int64_t>(-box.first.x, 0, box.size.x);                    // before: the first one
  const std::int64_t x1 = std::clamp<std::int64_t>(extents.x - box.first.x, x0, box.size.x);        // from here on: the last one
  float* to = out.data();
  for (int coset = 0; coset < coset_count(part.lattice); ++coset)
    for (std::int64_t k = box.first.z; k < box.first.z + box.size.z; ++k)
      for (std::int64_t j = box.first.y; j < box.first.y + box.size.y; ++j, to += box.size.x) {
        const glm::i64vec3 row = glm::clamp(glm::i64vec3(box.first.x + x0, j, k), glm::i64vec3(0), last) - begin;
        const float* from = part.data.data() + part.number(coset, row);
        std::fill(to, to + x0, *from);
        std::copy(from, from + (x1 - x0), to + x0);
        const float end = x1 > x0 ? to[x1 - 1] : *from;
        std::fill(to + x1, to + box.size.x, end);
      }
}

}  // namespace

void box_coefficients(const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, const ValueUnit& unit, const IndexBox& box,
                      std::span<float> out) {
  const Extents& extents = source.header().extents;
  const glm::i64vec3 last = extents - std::int64_t(1), zero(0);
  const std::int64_t reach = spline.filter(prefilter).reach;
  // A side that the prefilter finds clamped is the volume's own, or too far from the box to matter.
  const glm::i64vec3 low = glm::max(glm::clamp(box.first, zero, last) - reach, zero);
  const glm::i64vec3 high = glm::min(glm::clamp(box.first + box.size - std::int64_t(1), zero, last) + reach, last) + std::int64_t(1);
  copy_clamped(spline.coefficients_float(source.read_box(low, high), prefilter, unit), low, extents, box, out);
}

void copy_box(const Coefficients<float>& whole, const IndexBox& box, std::span<float> out) {
  copy_clamped(whole, glm::i64vec3(0), whole.extents, box, out);
}

}  // namespace quincunx

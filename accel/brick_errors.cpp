#include "accel/brick_errors.h"

#include <algorithm>
#include <limits>

namespace quincunx {
namespace {

constexpr NumberRange kNothing{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};

/// Of the indices low <= index < high of every coset, relative to the first coefficient of `part`.
NumberRange range_within(const Coefficients<float>& part, const glm::i64vec3& low, const glm::i64vec3& high) {
  NumberRange range = kNothing;
  for (int coset = 0; coset < coset_count(part.lattice); ++coset)
    for (std::int64_t k = low.z; k < high.z; ++k)
      for (std::int64_t j = low.y; j < high.y; ++j) {
        const float* row = part.data.data() + part.number(coset, glm::i64vec3(0, j, k) - std::int64_t(part.apron));
        for (std::int64_t i = low.x; i < high.x; ++i) {
          range.low = std::min(range.low, row[i]);
          range.high = std::max(range.high, row[i]);
        }
      }
  return range;
}

}  // namespace

BrickErrors::BrickErrors(const BrickLayout& layout) : layout_(layout), ranges_(std::size_t(layout.count()), kNothing) {}

void BrickErrors::add(const Coefficients<float>& part, const glm::i64vec3& first) {
  const glm::i64vec3 end = first + part.padded(), zero(0), bricks(layout_.bricks), origin = layout_.first_index(glm::ivec3(0));
  const std::int64_t samples = layout_.samples, pitch = layout_.edge / lattice_step(layout_.lattice);
  // The bricks whose slots, `samples` from origin + pitch * brick on, reach into the part.
  const glm::i64vec3 from = glm::clamp((first - origin - samples) / pitch, zero, bricks);
  const glm::i64vec3 to = glm::clamp((end - origin + pitch - std::int64_t(1)) / pitch, zero, bricks);
  for (std::int64_t z = from.z; z < to.z; ++z)
    for (std::int64_t y = from.y; y < to.y; ++y)
      for (std::int64_t x = from.x; x < to.x; ++x) {
        const glm::ivec3 brick(x, y, z);
        const glm::i64vec3 slot = layout_.first_index(brick);
        const NumberRange range = range_within(part, glm::max(slot, first) - first, glm::min(slot + samples, end) - first);
        const std::lock_guard lock(mutex_);
        NumberRange& known = ranges_[std::size_t(layout_.number(brick))];
        known = {std::min(known.low, range.low), std::max(known.high, range.high)};
      }
}

std::vector<double> BrickErrors::errors() const {
  std::vector<double> largest(ranges_.size());
  std::transform(ranges_.begin(), ranges_.end(), largest.begin(),
                 [&](const NumberRange& range) { return storage_error(layout_.storage, range.low, range.high); });
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> own = largest;
    for (std::int32_t n = 0; n < layout_.count(); ++n)
      for (const int side : {-1, 1}) {
        glm::ivec3 beside = layout_.brick(n);
        beside[axis] += side;
        if (beside[axis] < 0 || beside[axis] >= layout_.bricks[axis]) continue;
        largest[std::size_t(n)] = std::max(largest[std::size_t(n)], own[std::size_t(layout_.number(beside))]);
      }
  }
  return largest;
}

}  // namespace quincunx

#include "accel/magnitude.h"

#include <algorithm>
#include <cmath>

namespace quincunx {
namespace {

/// into[i] = max(into[i], from[i]).
void widen(float* into, const float* from, std::int64_t n) {
  for (std::int64_t i = 0; i < n; ++i) into[i] = into[i] < from[i] ? from[i] : into[i];
}

/// The largest |coefficient| of both cosets within `reach` along x of each i of the row (j,k); `scratch` holds n
/// numbers.
void row_magnitudes(const Coefficients<float>& c, std::int64_t reach, std::int64_t j, std::int64_t k, float* scratch, float* row) {
  const std::int64_t n = c.extents.x;
  const float* even = c.data.data() + c.number(0, {0, j, k});
  const float* odd = c.data.data() + c.number(1, {0, j, k});
  for (std::int64_t i = 0; i < n; ++i) {
    const float a = std::fabs(even[i]), b = std::fabs(odd[i]);
    scratch[i] = a < b ? b : a;
  }
  std::copy(scratch, scratch + n, row);
  for (std::int64_t shift = 1; shift <= std::min(reach, n - 1); ++shift) {
    widen(row, scratch + shift, n - shift);
    widen(row + shift, scratch, n - shift);
  }
}

}  // namespace

void Magnitudes::compute(const Coefficients<float>& c, std::int64_t first_j, std::int64_t count_j, std::int64_t first_k,
                         std::int64_t count_k) {
  width_ = c.extents.x, first_j_ = first_j, first_k_ = first_k, count_j_ = count_j;
  // The samples beyond the border repeat those at it: clip to the volume.
  const std::int64_t j0 = std::max<std::int64_t>(first_j - reach_, 0), k0 = std::max<std::int64_t>(first_k - reach_, 0);
  const std::int64_t j1 = std::min(first_j + count_j + reach_, c.extents.y);
  const std::int64_t k1 = std::min(first_k + count_k + reach_, c.extents.z);
  raw_.resize(std::size_t(2 * width_));
  along_y_.assign(std::size_t(count_j * (k1 - k0) * width_), 0.0f);
  rows_.assign(std::size_t(count_j * count_k * width_), 0.0f);

  for (std::int64_t k = k0; k < k1; ++k) {
    for (std::int64_t j = j0; j < j1; ++j) {
      row_magnitudes(c, reach_, j, k, raw_.data(), raw_.data() + width_);
      for (std::int64_t to = std::max(j - reach_, first_j); to <= std::min(j + reach_, first_j + count_j - 1); ++to)
        widen(along_y_.data() + ((k - k0) * count_j + (to - first_j)) * width_, raw_.data() + width_, width_);
    }
    for (std::int64_t to = std::max(k - reach_, first_k); to <= std::min(k + reach_, first_k + count_k - 1); ++to)
      widen(rows_.data() + (to - first_k) * count_j * width_, along_y_.data() + (k - k0) * count_j * width_,
            count_j * width_);
  }
}

}  // namespace quincunx

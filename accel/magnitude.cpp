#include "accel/magnitude.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quincunx {
namespace {

/// into[i] = max(into[i], from[i]).
void widen(float* into, const float* from, std::int64_t n) {
  for (std::int64_t i = 0; i < n; ++i) into[i] = into[i] < from[i] ? from[i] : into[i];
}

float number(float c, Magnitudes::Of of) {
  return of == Magnitudes::Of::absolute ? std::fabs(c) : of == Magnitudes::Of::value ? c : -c;
}

/// The largest number of both cosets near along x of each i of the row (j,k), its apron's too, from which `row` and `scratch` begin.
void row_magnitudes(const Coefficients<float>& c, const Magnitudes::Near& near, Magnitudes::Of of, std::int64_t j, std::int64_t k, float* scratch, float* row) {
  const std::int64_t n = c.extents.x + 2 * c.apron;
  const float* even = c.data.data() + c.number(0, {-c.apron, j, k});
  const float* odd = c.data.data() + c.number(1, {-c.apron, j, k});
  for (std::int64_t i = 0; i < n; ++i) {
    const float a = number(even[i], of), b = number(odd[i], of);
    scratch[i] = a < b ? b : a;
  }
  std::copy(scratch, scratch + n, row);
  for (std::int64_t shift = 1; shift <= std::min<std::int64_t>(near.after, n - 1); ++shift) widen(row, scratch + shift, n - shift);
  for (std::int64_t shift = 1; shift <= std::min<std::int64_t>(near.before, n - 1); ++shift) widen(row + shift, scratch, n - shift);
}

}  // namespace

void Magnitudes::compute(const Coefficients<float>& c, const Near& near, Of of, std::int64_t first_j, std::int64_t count_j, std::int64_t first_k,
                         std::int64_t count_k) {
  width_ = c.extents.x, first_j_ = first_j, first_k_ = first_k, count_j_ = count_j;
  const std::int64_t before = near.before, after = near.after, apron = c.apron, padded = width_ + 2 * apron;
  const std::int64_t j0 = std::max(first_j - before, -apron), k0 = std::max(first_k - before, -apron);
  const std::int64_t j1 = std::min(first_j + count_j + after, c.extents.y + apron);
  const std::int64_t k1 = std::min(first_k + count_k + after, c.extents.z + apron);
  constexpr float none = std::numeric_limits<float>::lowest();
  raw_.resize(std::size_t(2 * padded));
  along_y_.assign(std::size_t(count_j * (k1 - k0) * width_), none);
  rows_.assign(std::size_t(count_j * count_k * width_), none);

  for (std::int64_t k = k0; k < k1; ++k) {
    for (std::int64_t j = j0; j < j1; ++j) {
      row_magnitudes(c, near, of, j, k, raw_.data(), raw_.data() + padded);
      for (std::int64_t to = std::max(j - after, first_j); to <= std::min(j + before, first_j + count_j - 1); ++to)
        widen(along_y_.data() + ((k - k0) * count_j + (to - first_j)) * width_, raw_.data() + padded + apron, width_);
    }
    for (std::int64_t to = std::max(k - after, first_k); to <= std::min(k + before, first_k + count_k - 1); ++to)
      widen(rows_.data() + (to - first_k) * count_j * width_, along_y_.data() + (k - k0) * count_j * width_,
            count_j * width_);
  }
}

}  // namespace quincunx

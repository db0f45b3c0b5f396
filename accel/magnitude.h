// How large the coefficients are near a cell: the scale of the rounding errors there.
#pragma once

#include <cstdint>
#include <vector>

#include "spline/coefficients.h"

namespace quincunx {

/// For rows of cells, the largest |coefficient| (or coefficient, or its negative) among the samples that reach a cell or one of its 26
/// neighbours, or a little more: one number for the 8 cells 2i..2i+1, 2j..2j+1, 2k..2k+1, the largest of both cosets from (i,j,k) - before
/// to (i,j,k) + after.
class Magnitudes {
 public:
  enum class Of { absolute, value, negative };
  /// At most 3 each.
  struct Near {
    int before, after;
  };

  /// Of the index box [first, first+count) along y and z and all of x. `c` is bcc; what is beyond its apron does not count.
  void compute(const Coefficients<float>& c, const Near& near, Of of, std::int64_t first_j, std::int64_t count_j, std::int64_t first_k,
               std::int64_t count_k);

  /// The row (j,k), indexed by i.
  const float* row(std::int64_t j, std::int64_t k) const {
    return rows_.data() + ((k - first_k_) * count_j_ + (j - first_j_)) * width_;
  }

 private:
  std::int64_t reach_, width_ = 0, first_j_ = 0, first_k_ = 0, count_j_ = 0;
  std::vector<float> rows_, raw_, along_y_;
};

}  // namespace quincunx

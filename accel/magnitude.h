// How large the coefficients are near a cell: the scale of the rounding errors there.
#pragma once

#include <cstdint>
#include <vector>

#include "spline/coefficients.h"

namespace quincunx {

/// For rows of cells, the largest |coefficient| among the samples that reach a cell or one of its 26 neighbours, or a
/// little more: one number for the 8 cells 2i..2i+1, 2j..2j+1, 2k..2k+1, the largest of both cosets within `reach` of
/// (i,j,k). Of bcc7 it is 2: a cell X is reached from X-2..X+3, its neighbours from X-3..X+4, so the pair from 2i-3..2i+5. Of bcc12 it
/// is 3: a cell is reached from X-3..X+4, the pair and its neighbours from 2i-4..2i+6.
class Magnitudes {
 public:
  explicit Magnitudes(std::int64_t reach = 2) : reach_(reach) {}

  /// Of the index box [first, first+count) along y and z and all of x. `c` is bcc.
  void compute(const Coefficients<float>& c, std::int64_t first_j, std::int64_t count_j, std::int64_t first_k,
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

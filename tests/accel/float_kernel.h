// What a kernel computes of a spline in 32-bit floats, cell by cell.
#pragma once

#include <memory>
#include <vector>

#include "spline/spline.h"

namespace quincunx {

/// A piece as a kernel sees it, every operation in floats; also at points beside the piece, where it goes on.
class FloatKernel {
 public:
  virtual ~FloatKernel() = default;
  /// The value at u, lattice coordinates; what u is from the cell's corner is rounded to floats.
  virtual float value(const glm::dvec3& u) const = 0;
  /// The Bernstein coefficients along a..b; of pieces that are no polynomials, some values.
  virtual std::vector<float> bernstein(const glm::dvec3& a, const glm::dvec3& b) const = 0;
  /// A vertex of the piece, n = 0, 1 ...
  virtual glm::dvec3 vertex(int n) const = 0;
};

/// The piece of `cell` that holds u, or is nearest to it.
std::unique_ptr<FloatKernel> float_kernel(const Spline& spline, const Coefficients<float>& c, const glm::ivec3& cell,
                                          const glm::dvec3& u);

}  // namespace quincunx

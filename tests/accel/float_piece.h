// What a kernel computes: the spline on one tetrahedron in 32-bit floats, in monomial form.
#pragma once

#include <array>

#include "spline/coefficients.h"
#include "spline/tetrahedron.h"

namespace quincunx {

/// The quartic of the bcc7 spline on a tetrahedron as 35 monomials (3 of them 0) of its frame's coordinates (w1, w2,
/// w3), every operation in floats: the monomials' coefficients from the samples by integer weights, then Horner's rule,
/// then 1/384.
class FloatPiece {
 public:
  FloatPiece(const Coefficients<float>& c, const Tetrahedron& tetrahedron);

  float value(const glm::vec3& w) const;
  /// The 5 Bernstein coefficients along a..b, interpolated from 5 values.
  std::array<float, 5> bernstein(const glm::vec3& a, const glm::vec3& b) const;

 private:
  std::array<float, 35> monomials_;  ///< 384 times those of w1^i w2^j w3^k, i + j + k <= 4, k fastest
};

}  // namespace quincunx

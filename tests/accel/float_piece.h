// What a kernel computes: a box spline of the BCC lattice on one tetrahedron in 32-bit floats, in monomial form.
#pragma once

#include <vector>

#include "spline/box_net.h"
#include "spline/coefficients.h"
#include "spline/tetrahedron.h"

namespace quincunx {

/// A sample that reaches the reference tetrahedron 1 >= w1 >= w2 >= w3 >= 0, and its weights in the monomials.
struct StencilSample {
  glm::ivec3 at;  ///< frame coordinates from the even corner
  std::vector<float> weight;
};

/// Of the spline with that net.
std::vector<StencilSample> piece_stencil(const NetView& net);

/// The polynomial on a tetrahedron as monomials (some of them 0) of its frame's coordinates (w1, w2, w3), every operation in floats: the
/// monomials' coefficients from the samples by integer weights, then Horner's rule, then 1/denominator.
class FloatPiece {
 public:
  FloatPiece(const Coefficients<float>& c, const Tetrahedron& tetrahedron, const NetView& net, const std::vector<StencilSample>& stencil);

  float value(const glm::vec3& w) const;
  /// The Bernstein coefficients along a..b: a + t (b - a) substituted by Horner's rule on polynomials in t, then differences.
  std::vector<float> bernstein(const glm::vec3& a, const glm::vec3& b) const;

 private:
  const NetView& net_;
  std::vector<float> monomials_;  ///< `denominator` times those of w1^i w2^j w3^k, i + j + k <= degree, k fastest
};

}  // namespace quincunx

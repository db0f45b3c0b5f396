// Quartics on a tetrahedron in Bernstein-Bezier form.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace quincunx {

/// The 35 Bernstein coefficients of a quartic on a tetrahedron v0..v3. Coefficient number
/// quartic_number(i,j,k), 4 >= i >= j >= k >= 0, belongs to the point v0 + (i (v1-v0) + j (v2-v1) + k (v3-v2)) / 4.
/// The numbers do not depend on the degree: the first 20 are those of a cubic, the first 10 those of a quadric.
using QuarticNet = std::array<double, 35>;

constexpr int quartic_number(int i, int j, int k) { return i * (i + 1) * (i + 2) / 6 + j * (j + 1) / 2 + k; }

/// Value, and derivatives along v1-v0, v2-v1 and v3-v2, at the barycentric point `b`.
struct QuarticJet {
  double value;
  glm::dvec3 derivatives;
};
QuarticJet evaluate_quartic(const QuarticNet& net, const glm::dvec4& b);

/// The 5 Bernstein coefficients of the quartic along the segment between the barycentric points `a` and `b`
/// (blossoming: coefficient m is the polar form at 4 - m times `a` and m times `b`).
std::array<double, 5> restrict_quartic(const QuarticNet& net, const glm::dvec4& a, const glm::dvec4& b);

}  // namespace quincunx

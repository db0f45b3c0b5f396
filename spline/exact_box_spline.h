// Box splines in exact rational arithmetic: slow, and beyond doubt.
#pragma once

#include <gmpxx.h>

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <vector>

namespace quincunx {

using RationalPoint = std::array<mpq_class, 3>;

/// The centred box spline of up to 16 integer directions that span space, of integral 1, by the recursion of
/// C. de Boor, K. Hoellig, S. Riemenschneider, Box Splines, Springer 1993: with x = sum_r t_r xi_r (the least-norm t),
///   (n - 3) M(x) = sum_r t_r M_r(x) + (1 - t_r) M_r(x - xi_r),
/// M_r the box spline without direction r, not centred. Values are right at points on no knot plane; the points on
/// knot planes are for those who know the polynomials (box_net_derivation.h).
class ExactBoxSpline {
 public:
  explicit ExactBoxSpline(std::vector<glm::ivec3> directions);

  mpq_class value(const RationalPoint& x);
  /// The gradient; the directions hold 2 e_a for each axis (asserted): d/dx_a M(x) = (M_r(x) - M_r(x - 2 e_a)) / 2.
  RationalPoint gradient(const RationalPoint& x);

 private:
  using Subset = unsigned;  // one bit per direction
  /// The rows of X^T (X X^T)^-1, so that t_r = row_r . x; empty where the directions do not span space.
  const std::vector<RationalPoint>& pseudo_inverse(Subset subset);
  /// Whether x is outside the bounding box of the support (not centred).
  bool outside_box(Subset subset, const RationalPoint& x) const;
  /// Not centred: the sum over the cube [0,1]^n starts at the origin. Values met on the way are kept in `known`.
  mpq_class recurse(Subset subset, const RationalPoint& x,
                    std::map<std::pair<Subset, RationalPoint>, mpq_class>& known);
  mpq_class uncentred(Subset subset, const RationalPoint& x);
  RationalPoint shifted_to_origin(const RationalPoint& x) const;

  std::vector<glm::ivec3> directions_;
  std::map<Subset, std::vector<RationalPoint>> inverses_;
};

/// M4, M7 and M8 are 4 times the centred box splines of these.
std::vector<glm::ivec3> bcc4_directions();
std::vector<glm::ivec3> bcc7_directions();
std::vector<glm::ivec3> bcc8_directions();

}  // namespace quincunx

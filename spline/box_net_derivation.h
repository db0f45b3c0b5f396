// What is derived of the box splines of the BCC lattice: their Bernstein-Bezier nets and the polynomials on the reference
// tetrahedron, and the files made of them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "spline/linear_program.h"

namespace quincunx {

/// A spline to derive: its generator is 4 times the centred box spline of `directions`, which are invariant under the symmetries of the
/// cube but for signs, and whose knot planes are among those of spline/tetrahedron.h.
struct DerivedSpline {
  std::string name;  ///< that of its files: spline/<name>_net.h, shaders/<name>_tables.glsl
  std::vector<glm::ivec3> directions;
  int scale;  ///< a kernel's values are this many times the spline's: of the scales of exact factors the one with the fewest operations

  int degree() const { return int(directions.size()) - 3; }
  /// How far the support goes along an axis, lattice units.
  int reach() const;
};

/// The list of them.
const std::vector<DerivedSpline>& derived_splines();

/// A point of the grid (1/n)Z^3 in n-ths, n the degree, or the exponents of a monomial.
using GridPoint = std::array<int, 3>;

/// A net: its numerators where it is not zero, at grid points i >= j >= k >= 0.
struct ExactNet {
  int degree = 0, denominator = 1;
  std::map<GridPoint, int> numerators;

  /// At any grid point, by symmetry.
  int at(const glm::ivec3& q) const;
};

/// By exact interpolation of the exact box spline on every tetrahedron of the sector x >= y >= z >= 0. Throws std::logic_error where two
/// tetrahedra disagree.
ExactNet derive_net(const DerivedSpline& spline);

/// The samples whose generators reach the reference tetrahedron 1 >= x >= y >= z >= 0, v0 = (0,0,0) all even,
/// ascending.
std::vector<glm::ivec3> stencil_of(const ExactNet& net);

/// `denominator` times the coefficient of x^a y^b z^c of the spline on the reference tetrahedron, as a form of the stencil's
/// samples; the monomials that never occur are left out.
std::map<GridPoint, LinearForm> monomials_of(const ExactNet& net, const std::vector<glm::ivec3>& stencil);

/// The text of spline/<name>_net.h.
std::string net_header(const DerivedSpline& spline, const ExactNet& net);

/// The text of shaders/<name>_tables.glsl.
std::string piece_tables_glsl(const DerivedSpline& spline, const ExactNet& net);

}  // namespace quincunx

// What is derived of bcc7: its Bernstein-Bezier net and the polynomial on the reference tetrahedron, and the files made
// of them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "spline/linear_program.h"

namespace quincunx {

/// Numerators over 384 of the net of M7 at the quarter-grid points i >= j >= k >= 0 where it is not zero, from exact
/// interpolation of the exact box spline on every tetrahedron of that sector. Throws std::logic_error where two
/// tetrahedra disagree or a coefficient is no integer over 384.
using QuarterPoint = std::array<int, 3>;
std::map<QuarterPoint, int> derive_bcc7_net();

/// The net at any quarter-grid point, by symmetry.
int net_at(const std::map<QuarterPoint, int>& net, const glm::ivec3& q);

/// The samples whose generators reach the reference tetrahedron 1 >= x >= y >= z >= 0, v0 = (0,0,0) all even,
/// ascending.
std::vector<glm::ivec3> bcc7_stencil(const std::map<QuarterPoint, int>& net);

/// 384 times the coefficient of x^a y^b z^c of the spline on the reference tetrahedron, as a form of the stencil's
/// samples; the monomials that never occur are left out.
std::map<QuarterPoint, LinearForm> bcc7_monomials(const std::map<QuarterPoint, int>& net,
                                                  const std::vector<glm::ivec3>& stencil);

/// The text of spline/bcc7_net.h.
std::string bcc7_net_header(const std::map<QuarterPoint, int>& net);

/// The text of shaders/bcc7_tables.glsl.
std::string bcc7_tables_glsl(const std::map<QuarterPoint, int>& net);

}  // namespace quincunx

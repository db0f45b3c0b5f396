// What the box splines of the BCC lattice share (twin of spline/kuhn_spline_bodies.h), 32-bit floats. Before it, the spline's file includes its
// tables (shaders/<name>_tables.glsl) and defines SPLINE_DEGREE and SPLINE_RESTRICT(b, a, d), which is PIECE_RESTRICT of their elements.
//
// One routine serves all 24 kinds of tetrahedron: E is the cell's all-even corner, `sign` leads from it to the all-odd one,
// u = sign * (p - E) is in [0,1]^3, and sorting u descending picks the Kuhn tetrahedron. Seen in that order of
// axes every stencil looks alike, so strides are signed and permuted instead of tables. All values are
// SPLINE_SCALE times the spline's: the division never happens.
const real SPLINE_SCALE = PIECE_SCALE;
#define SPLINE_CUTS 3

#include "bcc_cell.glsl"

// The order of axes in which u descends: which axis comes first and which last.
struct AxisOrder {
  bool first_x, first_y, middle_x, middle_y, last_x, last_y;
};
AxisOrder axis_order(rvec3 u) {
  bool xy = u.x >= u.y, yz = u.y >= u.z, xz = u.x >= u.z;
  AxisOrder r;
  r.first_x = xy && xz;
  r.first_y = !xy && yz;
  r.last_x = !xy && !xz;
  r.last_y = xy && !yz;
  r.middle_x = !r.first_x && !r.last_x;
  r.middle_y = !r.first_y && !r.last_y;
  return r;
}
// As a number below 16, and back.
uint order_code(AxisOrder r) { return (r.first_x ? 1u : 0u) | (r.first_y ? 2u : 0u) | (r.last_x ? 4u : 0u) | (r.last_y ? 8u : 0u); }
AxisOrder coded_order(uint code) {
  AxisOrder r;
  r.first_x = (code & 1u) != 0u;
  r.first_y = (code & 2u) != 0u;
  r.last_x = (code & 4u) != 0u;
  r.last_y = (code & 8u) != 0u;
  r.middle_x = !r.first_x && !r.last_x;
  r.middle_y = !r.first_y && !r.last_y;
  return r;
}
rvec3 in_order(AxisOrder r, rvec3 v) {
  return rvec3(r.first_x ? v.x : (r.first_y ? v.y : v.z), r.middle_x ? v.x : (r.middle_y ? v.y : v.z),
              r.last_x ? v.x : (r.last_y ? v.y : v.z));
}
ivec3 in_order(AxisOrder r, ivec3 v) {
  return ivec3(r.first_x ? v.x : (r.first_y ? v.y : v.z), r.middle_x ? v.x : (r.middle_y ? v.y : v.z),
               r.last_x ? v.x : (r.last_y ? v.y : v.z));
}
rvec3 out_of_order(AxisOrder r, rvec3 v) {
  return rvec3(r.first_x ? v.x : (r.middle_x ? v.y : v.z), r.first_y ? v.x : (r.middle_y ? v.y : v.z),
              !(r.first_x || r.first_y) ? v.x : (!(r.middle_x || r.middle_y) ? v.y : v.z));
}

// The ray from entry to exit of a cell: u(tau) = start + tau d, 0 <= tau <= length, crosses the planes between
// tetrahedra (u_i = u_j) at cut.x <= cut.y <= cut.z; those outside are moved to the end.
const real SHORTEST_PIECE = BY_PRECISION(1e-5, 1e-13lf);

rvec3 spline_cuts(rvec3 start, rvec3 d, real len) {
  precise rvec3 gap = start.yzx - start;
  rvec3 closing = d - d.yzx;
  precise rvec3 tau = mix(rvec3(len), gap / closing, greaterThan(abs(closing), rvec3(1e-12)));
  tau = mix(min(tau, rvec3(len)), rvec3(len), lessThan(tau, rvec3(SHORTEST_PIECE)));
  real low = min(tau.x, min(tau.y, tau.z));
  real high = max(tau.x, max(tau.y, tau.z));
  real middle = max(min(tau.x, tau.y), min(max(tau.x, tau.y), tau.z));
  return rvec3(low, middle, high);
}

// The tetrahedron of u's order: the polynomial's monomial coefficients, in the macros' local variables.
#define SPLINE_POLYNOMIAL(cell, order)                        \
  ivec3 spline_stride = in_order(order, (cell).stride);        \
  PIECE_FETCH((cell).E, (cell).O, spline_stride.x, spline_stride.y, spline_stride.z) \
  PIECE_MONOMIALS

// Bernstein coefficients (SPLINE_SCALE times, less `offset`) along a..a+d, which lies in the tetrahedron of `order`.
void spline_restrict(SplineCell cell, AxisOrder order, rvec3 a, rvec3 d, real offset, out real b[SPLINE_DEGREE + 1]) {
  SPLINE_POLYNOMIAL(cell, order)
  c000 -= offset;
  rvec3 p = in_order(order, a);
  rvec3 q = in_order(order, d);
  SPLINE_RESTRICT(b, p, q)
}

#define SPLINE_GRADIENT(w) rvec3(PIECE_DX(w.x, w.y, w.z), PIECE_DY(w.x, w.y, w.z), PIECE_DZ(w.x, w.y, w.z))

#if defined(MARCH) || defined(NORMAL_CENTRAL) || defined(VOLUME)
// SPLINE_SCALE times the value at u, less `offset`.
real spline_value(SplineCell cell, rvec3 u, real offset) {
  AxisOrder order = axis_order(u);
  SPLINE_POLYNOMIAL(cell, order)
  c000 -= offset;
  rvec3 w = in_order(order, u);
  precise real f = PIECE_VALUE(w.x, w.y, w.z);
  return f;
}

#include "spline_at.glsl"
#endif

#ifdef VOLUME
// SPLINE_SCALE times the value at u, less `offset`, and the gradient of lattice coordinates.
void spline_jet(SplineCell cell, rvec3 u, real offset, out real value, out rvec3 gradient) {
  AxisOrder order = axis_order(u);
  SPLINE_POLYNOMIAL(cell, order)
  c000 -= offset;
  rvec3 w = in_order(order, u);
  precise real f = PIECE_VALUE(w.x, w.y, w.z);
  precise rvec3 g = SPLINE_GRADIENT(w);
  value = f;
  gradient = cell.sign * out_of_order(order, g);
}
#endif

// A gradient of any length at u, in lattice coordinates, after one Newton step `t` along d (lattice coordinates)
// towards the value 0 of the polynomial of `order` less `offset`. A step longer than `longest` is not made.
void spline_refine(SplineCell cell, AxisOrder order, rvec3 u, rvec3 d, real offset, real longest, out real t, out rvec3 gradient) {
  SPLINE_POLYNOMIAL(cell, order)
  c000 -= offset;
  rvec3 w = in_order(order, u);
  rvec3 along = in_order(order, cell.sign * d);
  precise real f = PIECE_VALUE(w.x, w.y, w.z);
  rvec3 g = SPLINE_GRADIENT(w);
  t = -f / dot(g, along);
  t = abs(t) <= longest ? t : 0.0;
  w += t * along;
  gradient = cell.sign * out_of_order(order, SPLINE_GRADIENT(w));
}

// Trilinear interpolation on the Cartesian lattice (twin of spline/trilinear.cpp), 32-bit floats.
#define SPLINE_DEGREE 3
const real SPLINE_SCALE = 1.0;
#include "cartesian.glsl"
#include "one_piece.glsl"
#include "corners.glsl"

Corners corners(SplineCell cell) {
  int y = cell.lowest + parameters.strides.x;
  int z = cell.lowest + parameters.strides.y;
  int yz = y + parameters.strides.y;
  return Corners(rvec4(coefficient(cell.lowest), coefficient(cell.lowest + 1), coefficient(y), coefficient(y + 1)),
                 rvec4(coefficient(z), coefficient(z + 1), coefficient(yz), coefficient(yz + 1)));
}

// Bernstein coefficients, less `offset`, along a..a+d: the polar form of the cubic, one axis after the other.
void spline_restrict(SplineCell cell, AxisOrder order, rvec3 a, rvec3 d, real offset, out real b[SPLINE_DEGREE + 1]) {
  Corners c = corners(cell);
  // On each of the four edges along x, the two ends: (y,z) = (0,0), (1,0), (0,1), (1,1).
  rvec4 edge = rvec4(c.low.xz, c.high.xz) - offset;
  precise rvec4 rise = rvec4(c.low.yw, c.high.yw) - rvec4(c.low.xz, c.high.xz);
  precise rvec4 p = edge + a.x * rise;
  precise rvec4 q = p + d.x * rise;
  // On each of the two faces z = 0, 1, the ends and twice the middle.
  precise rvec2 p_rise = p.yw - p.xz, q_rise = q.yw - q.xz;
  precise rvec2 pp = p.xz + a.y * p_rise, pq = pp + d.y * p_rise;
  precise rvec2 qp = q.xz + a.y * q_rise, qq = qp + d.y * q_rise;
  precise rvec2 middle = pq + qp;
  // Along the segment, three times the two in the middle.
  precise rvec3 face = rvec3(pp.x, middle.x, qq.x);
  precise rvec3 face_rise = rvec3(pp.y, middle.y, qq.y) - face;
  precise rvec3 begin = face + a.z * face_rise;
  precise rvec3 end = begin + d.z * face_rise;
  precise real b1 = (begin.y + end.x) * (1.0 / real(3.0));
  precise real b2 = (begin.z + end.y) * (1.0 / real(3.0));
  b[0] = begin.x;
  b[1] = b1;
  b[2] = b2;
  b[3] = end.z;
}

#if defined(MARCH) || defined(NORMAL_CENTRAL) || defined(VOLUME)
// The value at u, less `offset`.
real spline_value(SplineCell cell, rvec3 u, real offset) {
  real value;
  rvec3 gradient;
  corners_jet(corners(cell), u, offset, value, gradient);
  return value;
}

#include "spline_at.glsl"
#endif

#ifdef VOLUME
// The value at u, less `offset`, and the gradient of lattice coordinates.
void spline_jet(SplineCell cell, rvec3 u, real offset, out real value, out rvec3 gradient) {
  corners_jet(corners(cell), u, offset, value, gradient);
}
#endif

// The gradient at u after one Newton step `t` along d (lattice coordinates) towards the value 0 of the spline less `offset`. A step
// longer than `longest` is not made.
void spline_refine(SplineCell cell, AxisOrder order, rvec3 u, rvec3 d, real offset, real longest, out real t, out rvec3 gradient) {
  Corners c = corners(cell);
  real f;
  corners_jet(c, u, offset, f, gradient);
  t = -f / dot(gradient, d);
  t = abs(t) <= longest ? t : 0.0;
  corners_jet(c, u + t * d, offset, f, gradient);
}

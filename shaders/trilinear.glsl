// Trilinear interpolation on the Cartesian lattice (twin of spline/trilinear.cpp), 32-bit floats.
#define SPLINE_DEGREE 3
const float SPLINE_SCALE = 1.0;
#include "cartesian.glsl"

// The samples of a cell's corners (x,y) = (0,0), (1,0), (0,1), (1,1).
struct Corners {
  vec4 low, high;  // at z = 0, 1
};
Corners corners(SplineCell cell) {
  int y = cell.lowest + parameters.strides.x;
  int z = cell.lowest + parameters.strides.y;
  int yz = y + parameters.strides.y;
  return Corners(vec4(coefficient(cell.lowest), coefficient(cell.lowest + 1), coefficient(y), coefficient(y + 1)),
                 vec4(coefficient(z), coefficient(z + 1), coefficient(yz), coefficient(yz + 1)));
}

// Bernstein coefficients, less `offset`, along a..a+d: the polar form of the cubic, one axis after the other.
void spline_restrict(SplineCell cell, AxisOrder order, vec3 a, vec3 d, float offset, out float b[SPLINE_DEGREE + 1]) {
  Corners c = corners(cell);
  // On each of the four edges along x, the two ends: (y,z) = (0,0), (1,0), (0,1), (1,1).
  vec4 edge = vec4(c.low.xz, c.high.xz) - offset;
  precise vec4 rise = vec4(c.low.yw, c.high.yw) - vec4(c.low.xz, c.high.xz);
  precise vec4 p = edge + a.x * rise;
  precise vec4 q = p + d.x * rise;
  // On each of the two faces z = 0, 1, the ends and twice the middle.
  precise vec2 p_rise = p.yw - p.xz, q_rise = q.yw - q.xz;
  precise vec2 pp = p.xz + a.y * p_rise, pq = pp + d.y * p_rise;
  precise vec2 qp = q.xz + a.y * q_rise, qq = qp + d.y * q_rise;
  precise vec2 middle = pq + qp;
  // Along the segment, three times the two in the middle.
  precise vec3 face = vec3(pp.x, middle.x, qq.x);
  precise vec3 face_rise = vec3(pp.y, middle.y, qq.y) - face;
  precise vec3 begin = face + a.z * face_rise;
  precise vec3 end = begin + d.z * face_rise;
  precise float b1 = (begin.y + end.x) * (1.0 / 3.0);
  precise float b2 = (begin.z + end.y) * (1.0 / 3.0);
  b[0] = begin.x;
  b[1] = b1;
  b[2] = b2;
  b[3] = end.z;
}

// The value at u, less `offset`, and the gradient.
void corners_jet(Corners c, vec3 u, float offset, out float value, out vec3 gradient) {
  vec4 edge = vec4(c.low.xz, c.high.xz) - offset;
  precise vec4 rise = vec4(c.low.yw, c.high.yw) - vec4(c.low.xz, c.high.xz);
  precise vec4 p = edge + u.x * rise;
  precise vec2 p_rise = p.yw - p.xz, rise_rise = rise.yw - rise.xz;
  precise vec2 face = p.xz + u.y * p_rise, face_rise = rise.xz + u.y * rise_rise;
  precise float z_rise = face.y - face.x;
  precise float f = face.x + u.z * z_rise;
  precise vec3 g = vec3(face_rise.x + u.z * (face_rise.y - face_rise.x), p_rise.x + u.z * (p_rise.y - p_rise.x), z_rise);
  value = f;
  gradient = g;
}

#if defined(MARCH) || defined(NORMAL_CENTRAL) || defined(VOLUME)
// The value at u, less `offset`.
float spline_value(SplineCell cell, vec3 u, float offset) {
  float value;
  vec3 gradient;
  corners_jet(corners(cell), u, offset, value, gradient);
  return value;
}

#include "spline_at.glsl"
#endif

#ifdef VOLUME
// The value at u, less `offset`, and the gradient of lattice coordinates.
void spline_jet(SplineCell cell, vec3 u, float offset, out float value, out vec3 gradient) {
  corners_jet(corners(cell), u, offset, value, gradient);
}
#endif

// The gradient at u after one Newton step `t` along d (lattice coordinates) towards the value 0 of the spline less `offset`. A step
// longer than `longest` is not made.
void spline_refine(SplineCell cell, AxisOrder order, vec3 u, vec3 d, float offset, float longest, out float t, out vec3 gradient) {
  Corners c = corners(cell);
  float f;
  corners_jet(c, u, offset, f, gradient);
  t = -f / dot(gradient, d);
  t = abs(t) <= longest ? t : 0.0;
  corners_jet(c, u + t * d, offset, f, gradient);
}

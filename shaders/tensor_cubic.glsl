// Splines that are products along the axes of cubics from 4 samples each: on the Cartesian lattice, or the sum of two such, one on the grid of
// each coset, with the same weights. Before this file is included there are SplineCell, AxisOrder, SPLINE_SCALE and, for sums,
//   CUBES                        2: that many cubes of 4 x 4 x 4 samples reach a cell, and CUBE_STEP, their own coordinates per lattice coordinate
//   cube_first(cell, cube)       the number of a cube's first sample
//   cube_point(cell, cube, u)    the cube's own coordinates of u, in [0,1]^3 between its 8 samples in the middle
// Behind it follow weights(p, q), point_weights(x) and point_slopes(x): how much the samples at -1, 0, 1, 2 weigh, the cube root of
// SPLINE_SCALE / CUBES times too large, so that divisions never happen.
// No loop goes over cubes: Mesa does not unroll one of so large a body, not even over one cube.
#define SPLINE_DEGREE 9

#ifndef CUBES
#define CUBES 1
int cube_first(SplineCell cell, int cube) { return cell.lowest - 1 - parameters.strides.x - parameters.strides.y; }
rvec3 cube_point(SplineCell cell, int cube, rvec3 u) { return u; }
#endif

// A cubic on [0,1] as its Bernstein coefficients times 1, 3, 3, 1: a product's coefficients are then sums of products. One for each
// sample: its weight along p..q.
struct Weights {
  rvec4 first, second, third, fourth;
};
Weights weights(real p, real q);
// At x, and their derivatives.
rvec4 point_weights(real x);
rvec4 point_slopes(real x);

// Four samples along x in the row (j,k) of a cube.
rvec4 sample_row(int first, int j, int k) {
  int n = first + j * parameters.strides.x + k * parameters.strides.y;
  return rvec4(coefficient(n), coefficient(n + 1), coefficient(n + 2), coefficient(n + 3));
}
// The rows j = 0 .. 3 of a plane k.
struct SamplePlane {
  rvec4 row0, row1, row2, row3;
};
SamplePlane sample_plane(int first, int k) {
  return SamplePlane(sample_row(first, 0, k), sample_row(first, 1, k), sample_row(first, 2, k), sample_row(first, 3, k));
}

rvec4 weigh(Weights w, rvec4 samples) {
  precise rvec4 sum = (samples.x * w.first + samples.y * w.second) + (samples.z * w.third + samples.w * w.fourth);
  return sum;
}

// Products of polynomials so scaled.
struct Sextic {
  rvec4 low;   // coefficients 0 .. 3
  rvec3 high;  // 4 .. 6
};
Sextic product(rvec4 a, rvec4 b) {
  precise rvec4 low = rvec4(a.x * b.x, a.x * b.y + a.y * b.x, (a.x * b.z + a.z * b.x) + a.y * b.y,
                          (a.x * b.w + a.w * b.x) + (a.y * b.z + a.z * b.y));
  precise rvec3 high = rvec3((a.y * b.w + a.w * b.y) + a.z * b.z, a.z * b.w + a.w * b.z, a.w * b.w);
  return Sextic(low, high);
}
Sextic sum(Sextic a, Sextic b) {
  precise rvec4 low = a.low + b.low;
  precise rvec3 high = a.high + b.high;
  return Sextic(low, high);
}
// Of a plane, summed over its rows.
Sextic plane_polynomial(int first, int k, Weights x, Weights y) {
  SamplePlane s = sample_plane(first, k);
  return sum(sum(product(weigh(x, s.row0), y.first), product(weigh(x, s.row1), y.second)),
             sum(product(weigh(x, s.row2), y.third), product(weigh(x, s.row3), y.fourth)));
}
void add_product(Sextic a, rvec4 b, inout real sum[SPLINE_DEGREE + 1]) {
  real s[7] = real[7](a.low.x, a.low.y, a.low.z, a.low.w, a.high.x, a.high.y, a.high.z);
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 4; ++j) {
      precise real more = sum[i + j] + s[i] * b[j];
      sum[i + j] = more;
    }
}

// Of a cube, from a to e, coordinates of the cell.
void add_cube(SplineCell cell, int cube, rvec3 a, rvec3 e, inout real sum[SPLINE_DEGREE + 1]) {
  rvec3 p = cube_point(cell, cube, a), q = cube_point(cell, cube, e);
  int first = cube_first(cell, cube);
  Weights x = weights(p.x, q.x), y = weights(p.y, q.y), z = weights(p.z, q.z);
  add_product(plane_polynomial(first, 0, x, y), z.first, sum);
  add_product(plane_polynomial(first, 1, x, y), z.second, sum);
  add_product(plane_polynomial(first, 2, x, y), z.third, sum);
  add_product(plane_polynomial(first, 3, x, y), z.fourth, sum);
}

// Bernstein coefficients (SPLINE_SCALE times, less `offset`) along a..a+d.
void spline_restrict(SplineCell cell, AxisOrder order, rvec3 a, rvec3 d, real offset, out real b[SPLINE_DEGREE + 1]) {
  rvec3 e = a + d;
  for (int i = 0; i <= SPLINE_DEGREE; ++i) b[i] = 0.0;
  add_cube(cell, 0, a, e, b);
#if CUBES == 2
  add_cube(cell, 1, a, e, b);
#endif
  const real inverse_binomial[SPLINE_DEGREE + 1] =
      real[10](1.0, real(1.0) / 9.0, real(1.0) / 36.0, real(1.0) / 84.0, real(1.0) / 126.0, real(1.0) / 126.0, real(1.0) / 84.0, real(1.0) / 36.0, real(1.0) / 9.0, 1.0);
  for (int i = 0; i <= SPLINE_DEGREE; ++i) {
    precise real coefficient_less = b[i] * inverse_binomial[i] - offset;
    b[i] = coefficient_less;
  }
}

real weighted(rvec4 w, rvec4 s) {
  precise real sum = (w.x * s.x + w.y * s.y) + (w.z * s.z + w.w * s.w);
  return sum;
}
rvec4 along_rows(rvec4 w, SamplePlane s) { return rvec4(weighted(w, s.row0), weighted(w, s.row1), weighted(w, s.row2), weighted(w, s.row3)); }

// The samples of a cube.
struct Samples {
  SamplePlane plane0, plane1, plane2, plane3;
};
Samples cube_samples(SplineCell cell, int cube) {
  int first = cube_first(cell, cube);
  return Samples(sample_plane(first, 0), sample_plane(first, 1), sample_plane(first, 2), sample_plane(first, 3));
}

// What they make at u, the cube's own coordinates, less `offset`, and its gradient per own coordinate.
void samples_jet(Samples s, rvec3 u, real offset, out real value, out rvec3 gradient) {
  rvec4 wx = point_weights(u.x), wy = point_weights(u.y), wz = point_weights(u.z);
  rvec4 dx = point_slopes(u.x), dy = point_slopes(u.y), dz = point_slopes(u.z);
  rvec4 f0 = along_rows(wx, s.plane0), f1 = along_rows(wx, s.plane1), f2 = along_rows(wx, s.plane2), f3 = along_rows(wx, s.plane3);
  rvec4 g0 = along_rows(dx, s.plane0), g1 = along_rows(dx, s.plane1), g2 = along_rows(dx, s.plane2), g3 = along_rows(dx, s.plane3);
  rvec4 f = rvec4(weighted(wy, f0), weighted(wy, f1), weighted(wy, f2), weighted(wy, f3));
  rvec4 fx = rvec4(weighted(wy, g0), weighted(wy, g1), weighted(wy, g2), weighted(wy, g3));
  rvec4 fy = rvec4(weighted(dy, f0), weighted(dy, f1), weighted(dy, f2), weighted(dy, f3));
  value = weighted(wz, f) - offset;
  gradient = rvec3(weighted(wz, fx), weighted(wz, fy), weighted(dz, f));
}

#if CUBES == 2
// SPLINE_SCALE times the value at u, less `offset`, and the gradient of lattice coordinates.
void cell_jet(SplineCell cell, rvec3 u, real offset, out real value, out rvec3 gradient) {
  real more;
  rvec3 slope;
  samples_jet(cube_samples(cell, 0), cube_point(cell, 0, u), 0.0, value, gradient);
  samples_jet(cube_samples(cell, 1), cube_point(cell, 1, u), 0.0, more, slope);
  value = (value + more) - offset;
  gradient = CUBE_STEP * (gradient + slope);
}
#endif

#if defined(MARCH) || defined(NORMAL_CENTRAL) || defined(VOLUME)
real cube_value(SplineCell cell, int cube, rvec3 u) {
  rvec3 own = cube_point(cell, cube, u);
  int first = cube_first(cell, cube);
  rvec4 wx = point_weights(own.x), wy = point_weights(own.y), wz = point_weights(own.z);
  rvec4 f = rvec4(weighted(wy, along_rows(wx, sample_plane(first, 0))), weighted(wy, along_rows(wx, sample_plane(first, 1))),
                weighted(wy, along_rows(wx, sample_plane(first, 2))), weighted(wy, along_rows(wx, sample_plane(first, 3))));
  return weighted(wz, f);
}
// SPLINE_SCALE times the value at u, less `offset`.
real spline_value(SplineCell cell, rvec3 u, real offset) {
#if CUBES == 1
  return cube_value(cell, 0, u) - offset;
#else
  return (cube_value(cell, 0, u) + cube_value(cell, 1, u)) - offset;
#endif
}

#include "spline_at.glsl"
#endif

#ifdef VOLUME
// SPLINE_SCALE times the value at u, less `offset`, and the gradient of lattice coordinates.
void spline_jet(SplineCell cell, rvec3 u, real offset, out real value, out rvec3 gradient) {
#if CUBES == 1
  samples_jet(cube_samples(cell, 0), u, offset, value, gradient);
#else
  cell_jet(cell, u, offset, value, gradient);
#endif
}
#endif

// A gradient of any length at u, in lattice coordinates, after one Newton step `t` along d (lattice coordinates) towards the value 0 of
// the spline less `offset`. A step longer than `longest` is not made.
void spline_refine(SplineCell cell, AxisOrder order, rvec3 u, rvec3 d, real offset, real longest, out real t, out rvec3 gradient) {
#if CUBES == 1
  Samples s = cube_samples(cell, 0);
#define SPLINE_JET(u, value, gradient) samples_jet(s, u, offset, value, gradient)
#else
#define SPLINE_JET(u, value, gradient) cell_jet(cell, u, offset, value, gradient)
#endif
  real f;
  SPLINE_JET(u, f, gradient);
  t = -f / dot(gradient, d);
  t = abs(t) <= longest ? t : 0.0;
  SPLINE_JET(u + t * d, f, gradient);
}

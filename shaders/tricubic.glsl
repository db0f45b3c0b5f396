// The tricubic B-spline on the Cartesian lattice (twin of spline/tricubic.cpp), 32-bit floats.
//
// Along each axis x in [0,1] the samples at -1, 0, 1, 2 weigh (1-x)^3/6, w(x), w(1-x), x^3/6 with w(x) = (4 - 6x^2 + 3x^3)/6. The division
// by 6 never happens: all values are SPLINE_SCALE = 6^3 times the spline's.
#define SPLINE_DEGREE 9
const real SPLINE_SCALE = 216.0;
#include "cartesian.glsl"
#include "one_piece.glsl"

// Four samples along x, from -1 on, in the row (j,k) of the 4 x 4 x 4 that reach the cell.
rvec4 sample_row(SplineCell cell, int j, int k) {
  int n = cell.lowest - 1 + (j - 1) * parameters.strides.x + (k - 1) * parameters.strides.y;
  return rvec4(coefficient(n), coefficient(n + 1), coefficient(n + 2), coefficient(n + 3));
}
// The rows j = 0 .. 3 of a plane k.
struct SamplePlane {
  rvec4 row0, row1, row2, row3;
};
SamplePlane sample_plane(SplineCell cell, int k) {
  return SamplePlane(sample_row(cell, 0, k), sample_row(cell, 1, k), sample_row(cell, 2, k), sample_row(cell, 3, k));
}

// A cubic on [0,1] as its Bernstein coefficients times 1, 3, 3, 1: a product's coefficients are then sums of products. One for each
// sample: 6 times its weight along p..q.
struct Weights {
  rvec4 first, second, third, fourth;
};
rvec4 outer_weight(real p, real q) {
  precise rvec4 w = rvec4(p * p, 3.0 * (p * p), 3.0 * (q * q), q * q) * rvec4(p, q, p, q);
  return w;
}
// 4 - 2 (ab + bc + ca) + 3 abc at (a,b,c) = (p,p,p), (p,p,q), (p,q,q), (q,q,q).
rvec4 inner_weight(real p, real q) {
  precise real pp = p * p, pq = p * q, qq = q * q;
  precise rvec4 w = rvec4(4.0 + pp * (3.0 * p - 6.0), 12.0 + (pp * (9.0 * q - 6.0) - 12.0 * pq), 12.0 + (qq * (9.0 * p - 6.0) - 12.0 * pq),
                        4.0 + qq * (3.0 * q - 6.0));
  return w;
}
Weights weights(real p, real q) {
  return Weights(outer_weight(1.0 - p, 1.0 - q), inner_weight(p, q), inner_weight(1.0 - p, 1.0 - q), outer_weight(p, q));
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
Sextic plane_polynomial(SplineCell cell, int k, Weights x, Weights y) {
  SamplePlane s = sample_plane(cell, k);
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

// Bernstein coefficients (SPLINE_SCALE times, less `offset`) along a..a+d.
void spline_restrict(SplineCell cell, AxisOrder order, rvec3 a, rvec3 d, real offset, out real b[SPLINE_DEGREE + 1]) {
  rvec3 e = a + d;
  Weights x = weights(a.x, e.x), y = weights(a.y, e.y), z = weights(a.z, e.z);
  for (int i = 0; i <= SPLINE_DEGREE; ++i) b[i] = 0.0;
  add_product(plane_polynomial(cell, 0, x, y), z.first, b);
  add_product(plane_polynomial(cell, 1, x, y), z.second, b);
  add_product(plane_polynomial(cell, 2, x, y), z.third, b);
  add_product(plane_polynomial(cell, 3, x, y), z.fourth, b);
  const real inverse_binomial[SPLINE_DEGREE + 1] =
      real[10](1.0, real(1.0) / 9.0, real(1.0) / 36.0, real(1.0) / 84.0, real(1.0) / 126.0, real(1.0) / 126.0, real(1.0) / 84.0, real(1.0) / 36.0, real(1.0) / 9.0, 1.0);
  for (int i = 0; i <= SPLINE_DEGREE; ++i) {
    precise real coefficient_less = b[i] * inverse_binomial[i] - offset;
    b[i] = coefficient_less;
  }
}

// 6 times the weights at x, and their derivatives.
rvec4 point_weights(real x) {
  precise real y = 1.0 - x;
  precise rvec4 w = rvec4(y * y * y, 4.0 + x * x * (3.0 * x - 6.0), 4.0 + y * y * (3.0 * y - 6.0), x * x * x);
  return w;
}
rvec4 point_slopes(real x) {
  precise real y = 1.0 - x;
  precise rvec4 w = rvec4(-3.0 * (y * y), x * (9.0 * x - 12.0), y * (12.0 - 9.0 * y), 3.0 * (x * x));
  return w;
}
real weighted(rvec4 w, rvec4 s) {
  precise real sum = (w.x * s.x + w.y * s.y) + (w.z * s.z + w.w * s.w);
  return sum;
}
rvec4 along_rows(rvec4 w, SamplePlane s) { return rvec4(weighted(w, s.row0), weighted(w, s.row1), weighted(w, s.row2), weighted(w, s.row3)); }

// All samples that reach a cell.
struct Samples {
  SamplePlane plane0, plane1, plane2, plane3;
};
Samples cell_samples(SplineCell cell) {
  return Samples(sample_plane(cell, 0), sample_plane(cell, 1), sample_plane(cell, 2), sample_plane(cell, 3));
}

// SPLINE_SCALE times the value at u, less `offset`, and the gradient.
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

#if defined(MARCH) || defined(NORMAL_CENTRAL) || defined(VOLUME)
// SPLINE_SCALE times the value at u, less `offset`.
real spline_value(SplineCell cell, rvec3 u, real offset) {
  rvec4 wx = point_weights(u.x), wy = point_weights(u.y), wz = point_weights(u.z);
  rvec4 f = rvec4(weighted(wy, along_rows(wx, sample_plane(cell, 0))), weighted(wy, along_rows(wx, sample_plane(cell, 1))),
                weighted(wy, along_rows(wx, sample_plane(cell, 2))), weighted(wy, along_rows(wx, sample_plane(cell, 3))));
  return weighted(wz, f) - offset;
}

#include "spline_at.glsl"
#endif

#ifdef VOLUME
// SPLINE_SCALE times the value at u, less `offset`, and the gradient of lattice coordinates.
void spline_jet(SplineCell cell, rvec3 u, real offset, out real value, out rvec3 gradient) {
  samples_jet(cell_samples(cell), u, offset, value, gradient);
}
#endif

// A gradient of any length at u, in lattice coordinates, after one Newton step `t` along d (lattice coordinates) towards the value 0 of
// the spline less `offset`. A step longer than `longest` is not made.
void spline_refine(SplineCell cell, AxisOrder order, rvec3 u, rvec3 d, real offset, real longest, out real t, out rvec3 gradient) {
  Samples s = cell_samples(cell);
  real f;
  samples_jet(s, u, offset, f, gradient);
  t = -f / dot(gradient, d);
  t = abs(t) <= longest ? t : 0.0;
  samples_jet(s, u + t * d, offset, f, gradient);
}

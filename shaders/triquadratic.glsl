// The triquadratic B-spline on the Cartesian lattice (twin of spline/triquadratic.h), 32-bit floats.
//
// Its knots are in the middle between samples, so x, y, z = 1/2 cut a cell into eight pieces. In a piece's own coordinates t = x + 1/2 below
// and t = x - 1/2 above the cut, in [0,1], three samples along each axis weigh (1-t)^2/2, 1/2 + t(1-t), t^2/2. The division
// by 2 never happens: all values are SPLINE_SCALE = 2^3 times the spline's.
#define SPLINE_DEGREE 6
#define SPLINE_CUTS 3
const real SPLINE_SCALE = 8.0;
#include "cartesian.glsl"

// The piece: on which side of its cut each axis is.
struct AxisOrder {
  bvec3 above;
};
AxisOrder axis_order(rvec3 u) { return AxisOrder(greaterThanEqual(u, rvec3(0.5))); }
uint order_code(AxisOrder r) { return (r.above.x ? 1u : 0u) | (r.above.y ? 2u : 0u) | (r.above.z ? 4u : 0u); }
AxisOrder coded_order(uint code) { return AxisOrder(bvec3((code & 1u) != 0u, (code & 2u) != 0u, (code & 4u) != 0u)); }

// The ray from entry to exit of a cell: u(tau) = start + tau d, 0 <= tau <= len, crosses the planes u_i = 1/2 at
// cut.x <= cut.y <= cut.z; those outside are moved to the end.
const real SHORTEST_PIECE = BY_PRECISION(1e-5, 1e-13lf);

rvec3 spline_cuts(rvec3 start, rvec3 d, real len) {
  precise rvec3 gap = 0.5 - start;
  precise rvec3 tau = mix(rvec3(len), gap / d, greaterThan(abs(d), rvec3(1e-12)));
  tau = mix(min(tau, rvec3(len)), rvec3(len), lessThan(tau, rvec3(SHORTEST_PIECE)));
  real low = min(tau.x, min(tau.y, tau.z));
  real high = max(tau.x, max(tau.y, tau.z));
  real middle = max(min(tau.x, tau.y), min(max(tau.x, tau.y), tau.z));
  return rvec3(low, middle, high);
}

// A piece's own coordinates of u.
rvec3 own_point(AxisOrder r, rvec3 u) {
  precise rvec3 t = u + mix(rvec3(0.5), rvec3(-0.5), r.above);
  return t;
}

// The 27 samples of a piece, in rows along x.
struct SamplePlane {
  rvec3 row0, row1, row2;
};
struct Samples {
  SamplePlane plane0, plane1, plane2;
};
rvec3 sample_row(int n) { return rvec3(coefficient(n), coefficient(n + 1), coefficient(n + 2)); }
SamplePlane sample_plane(int n) {
  return SamplePlane(sample_row(n), sample_row(n + parameters.strides.x), sample_row(n + 2 * parameters.strides.x));
}
Samples piece_samples(SplineCell cell, AxisOrder r) {
  ivec3 first = mix(ivec3(-1), ivec3(0), r.above);
  int n = cell.lowest + first.x + first.y * parameters.strides.x + first.z * parameters.strides.y;
  return Samples(sample_plane(n), sample_plane(n + parameters.strides.y), sample_plane(n + 2 * parameters.strides.y));
}

// A quadratic on [0,1] as its Bernstein coefficients times 1, 2, 1: a product's coefficients are then sums of products. One for each
// sample: twice its weight along p..q.
struct Weights {
  rvec3 first, second, third;
};
Weights weights(real p, real q) {
  precise real np = 1.0 - p, nq = 1.0 - q;
  precise rvec3 first = rvec3(np * np, 2.0 * (np * nq), nq * nq);
  precise rvec3 second = rvec3(1.0 + 2.0 * (p * np), 2.0 + 2.0 * (p * nq + q * np), 1.0 + 2.0 * (q * nq));
  precise rvec3 third = rvec3(p * p, 2.0 * (p * q), q * q);
  return Weights(first, second, third);
}
rvec3 weigh(Weights w, rvec3 samples) {
  precise rvec3 sum = (samples.x * w.first + samples.y * w.second) + samples.z * w.third;
  return sum;
}

// Products of polynomials so scaled.
struct Quartic {
  rvec3 low;   // coefficients 0 .. 2
  rvec2 high;  // 3, 4
};
Quartic product(rvec3 a, rvec3 b) {
  precise rvec3 low = rvec3(a.x * b.x, a.x * b.y + a.y * b.x, (a.x * b.z + a.z * b.x) + a.y * b.y);
  precise rvec2 high = rvec2(a.y * b.z + a.z * b.y, a.z * b.z);
  return Quartic(low, high);
}
// Of a plane, summed over its rows.
Quartic plane_polynomial(SamplePlane s, Weights x, Weights y) {
  Quartic a = product(weigh(x, s.row0), y.first), b = product(weigh(x, s.row1), y.second), c = product(weigh(x, s.row2), y.third);
  precise rvec3 low = (a.low + b.low) + c.low;
  precise rvec2 high = (a.high + b.high) + c.high;
  return Quartic(low, high);
}
void add_product(Quartic a, rvec3 b, inout real sum[SPLINE_DEGREE + 1]) {
  real s[5] = real[5](a.low.x, a.low.y, a.low.z, a.high.x, a.high.y);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 3; ++j) {
      precise real more = sum[i + j] + s[i] * b[j];
      sum[i + j] = more;
    }
}

// Bernstein coefficients (SPLINE_SCALE times, less `offset`) along a..a+d, which lies in the piece of `order`.
void spline_restrict(SplineCell cell, AxisOrder order, rvec3 a, rvec3 d, real offset, out real b[SPLINE_DEGREE + 1]) {
  rvec3 p = own_point(order, a);
  precise rvec3 q = p + d;
  Weights x = weights(p.x, q.x), y = weights(p.y, q.y), z = weights(p.z, q.z);
  Samples s = piece_samples(cell, order);
  for (int i = 0; i <= SPLINE_DEGREE; ++i) b[i] = 0.0;
  add_product(plane_polynomial(s.plane0, x, y), z.first, b);
  add_product(plane_polynomial(s.plane1, x, y), z.second, b);
  add_product(plane_polynomial(s.plane2, x, y), z.third, b);
  const real inverse_binomial[SPLINE_DEGREE + 1] =
      real[7](1.0, real(1.0) / 6.0, real(1.0) / 15.0, real(1.0) / 20.0, real(1.0) / 15.0, real(1.0) / 6.0, 1.0);
  for (int i = 0; i <= SPLINE_DEGREE; ++i) {
    precise real coefficient_less = b[i] * inverse_binomial[i] - offset;
    b[i] = coefficient_less;
  }
}

// Twice the weights at t, and their derivatives.
rvec3 point_weights(real t) {
  precise real n = 1.0 - t;
  precise rvec3 w = rvec3(n * n, 1.0 + 2.0 * (t * n), t * t);
  return w;
}
rvec3 point_slopes(real t) {
  precise rvec3 w = rvec3(-2.0 * (1.0 - t), 2.0 - 4.0 * t, 2.0 * t);
  return w;
}
real weighted(rvec3 w, rvec3 s) {
  precise real sum = (w.x * s.x + w.y * s.y) + w.z * s.z;
  return sum;
}
rvec3 along_rows(rvec3 w, SamplePlane s) { return rvec3(weighted(w, s.row0), weighted(w, s.row1), weighted(w, s.row2)); }

// SPLINE_SCALE times the value at t, own coordinates of the piece, less `offset`, and the gradient.
void samples_jet(Samples s, rvec3 t, real offset, out real value, out rvec3 gradient) {
  rvec3 wx = point_weights(t.x), wy = point_weights(t.y), wz = point_weights(t.z);
  rvec3 dx = point_slopes(t.x), dy = point_slopes(t.y), dz = point_slopes(t.z);
  rvec3 f0 = along_rows(wx, s.plane0), f1 = along_rows(wx, s.plane1), f2 = along_rows(wx, s.plane2);
  rvec3 f = rvec3(weighted(wy, f0), weighted(wy, f1), weighted(wy, f2));
  rvec3 fx = rvec3(weighted(wy, along_rows(dx, s.plane0)), weighted(wy, along_rows(dx, s.plane1)), weighted(wy, along_rows(dx, s.plane2)));
  rvec3 fy = rvec3(weighted(dy, f0), weighted(dy, f1), weighted(dy, f2));
  value = weighted(wz, f) - offset;
  gradient = rvec3(weighted(wz, fx), weighted(wz, fy), weighted(dz, f));
}

#if defined(MARCH) || defined(NORMAL_CENTRAL) || defined(VOLUME)
// SPLINE_SCALE times the value at u, less `offset`.
real spline_value(SplineCell cell, rvec3 u, real offset) {
  AxisOrder order = axis_order(u);
  Samples s = piece_samples(cell, order);
  rvec3 t = own_point(order, u);
  rvec3 wx = point_weights(t.x), wy = point_weights(t.y);
  rvec3 f = rvec3(weighted(wy, along_rows(wx, s.plane0)), weighted(wy, along_rows(wx, s.plane1)), weighted(wy, along_rows(wx, s.plane2)));
  return weighted(point_weights(t.z), f) - offset;
}

#include "spline_at.glsl"
#endif

#ifdef VOLUME
// SPLINE_SCALE times the value at u, less `offset`, and the gradient of lattice coordinates.
void spline_jet(SplineCell cell, rvec3 u, real offset, out real value, out rvec3 gradient) {
  AxisOrder order = axis_order(u);
  samples_jet(piece_samples(cell, order), own_point(order, u), offset, value, gradient);
}
#endif

// A gradient of any length at u, in lattice coordinates, after one Newton step `t` along d (lattice coordinates) towards the value 0 of
// the polynomial of `order` less `offset`. A step longer than `longest` is not made.
void spline_refine(SplineCell cell, AxisOrder order, rvec3 u, rvec3 d, real offset, real longest, out real t, out rvec3 gradient) {
  Samples s = piece_samples(cell, order);
  rvec3 own = own_point(order, u);
  real f;
  samples_jet(s, own, offset, f, gradient);
  t = -f / dot(gradient, d);
  t = abs(t) <= longest ? t : 0.0;
  samples_jet(s, own + t * d, offset, f, gradient);
}

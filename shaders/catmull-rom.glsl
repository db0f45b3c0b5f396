// The Catmull-Rom spline along each axis of the Cartesian lattice (twin of spline/catmull_rom.h), 32-bit floats.
//
// At x in [0,1] the samples at -1, 0, 1, 2 weigh -x (1-x)^2 / 2, w(x), w(1-x), -x^2 (1-x) / 2 with w(x) = (2 - 5x^2 + 3x^3)/2.
const real SPLINE_SCALE = 8.0;
#include "cartesian.glsl"
#include "one_piece.glsl"
#include "tensor_cubic.glsl"

// Twice the polar form of -x (1-x)^2 / 2 at (p,p,p), (p,p,q), (p,q,q), (q,q,q), times 1, 3, 3, 1.
rvec4 outer_weight(real p, real q) {
  precise real np = 1.0 - p, nq = 1.0 - q;
  precise rvec4 w = -rvec4(p * (np * np), np * (2.0 * (p * nq) + q * np), nq * (p * nq + 2.0 * (q * np)), q * (nq * nq));
  return w;
}
// 2 - 5/3 (ab + bc + ca) + 3 abc.
rvec4 inner_weight(real p, real q) {
  precise real pp = p * p, pq = p * q, qq = q * q;
  precise rvec4 w = rvec4(2.0 + pp * (3.0 * p - 5.0), 6.0 + (pp * (9.0 * q - 5.0) - 10.0 * pq), 6.0 + (qq * (9.0 * p - 5.0) - 10.0 * pq),
                        2.0 + qq * (3.0 * q - 5.0));
  return w;
}
Weights weights(real p, real q) {
  return Weights(outer_weight(p, q), inner_weight(p, q), inner_weight(1.0 - p, 1.0 - q), outer_weight(1.0 - p, 1.0 - q));
}

rvec4 point_weights(real x) {
  precise real y = 1.0 - x;
  precise rvec4 w = rvec4(-x * (y * y), 2.0 + x * x * (3.0 * x - 5.0), 2.0 + y * y * (3.0 * y - 5.0), -y * (x * x));
  return w;
}
rvec4 point_slopes(real x) {
  precise real y = 1.0 - x;
  precise rvec4 w = rvec4(y * (3.0 * x - 1.0), x * (9.0 * x - 10.0), y * (10.0 - 9.0 * y), x * (3.0 * x - 2.0));
  return w;
}

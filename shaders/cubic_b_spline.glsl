// The weights of the centred cubic B-spline for tensor_cubic.glsl, 6 times too large.
//
// At x in [0,1] the samples at -1, 0, 1, 2 weigh (1-x)^3/6, w(x), w(1-x), x^3/6 with w(x) = (4 - 6x^2 + 3x^3)/6.
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

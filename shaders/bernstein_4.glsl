// Quartics in Bernstein form on [0,1]: what bernstein_n.glsl does, without loops over control points and clipped to the whole hull.

real least_of(real b[5]) { return min(min(b[0], b[4]), min(b[1], min(b[2], b[3]))); }
// s (b - c).
real[5] scaled_differences(real b[5], real c, real s) {
  return real[5](s * (b[0] - c), s * (b[1] - c), s * (b[2] - c), s * (b[3] - c), s * (b[4] - c));
}

// Where the segment (i, p) .. (j, q) of the control polygon comes down to 0, or 1.
real hull_crossing(real i, real p, real j, real q) { return p > 0.0 && q <= 0.0 ? 0.25 * (i + (j - i) * p / (p - q)) : 1.0; }

// The smallest place where the hull of five control points, the first one positive, reaches 0, or 1.
real hull_reaches_zero(real b0, real b1, real b2, real b3, real b4) {
  real x = min(min(hull_crossing(0.0, b0, 1.0, b1), hull_crossing(0.0, b0, 2.0, b2)),
                min(hull_crossing(0.0, b0, 3.0, b3), hull_crossing(0.0, b0, 4.0, b4)));
  x = min(x, min(min(hull_crossing(1.0, b1, 2.0, b2), hull_crossing(1.0, b1, 3.0, b3)), hull_crossing(1.0, b1, 4.0, b4)));
  return min(x, min(min(hull_crossing(2.0, b2, 3.0, b3), hull_crossing(2.0, b2, 4.0, b4)), hull_crossing(3.0, b3, 4.0, b4)));
}

// The root of a quartic that changes sign once, from positive at 0: bracketed Newton, values by de Casteljau.
real only_root(real b0, real b1, real b2, real b3, real b4) {
  real low = 0.0;
  real high = 1.0;
  real x = b0 / (b0 - b4);
  bool converged = false;
  for (int i = 0; i < BY_PRECISION(24, 60) && !converged; ++i) {
    real y = 1.0 - x;
    real p0 = y * b0 + x * b1, p1 = y * b1 + x * b2, p2 = y * b2 + x * b3, p3 = y * b3 + x * b4;
    p0 = y * p0 + x * p1, p1 = y * p1 + x * p2, p2 = y * p2 + x * p3;
    p0 = y * p0 + x * p1, p1 = y * p1 + x * p2;
    real f = y * p0 + x * p1;
    real slope = 4.0 * (p1 - p0);
    low = f > 0.0 ? x : low;
    high = f > 0.0 ? high : x;
    real next = x - f / slope;
    // Only a fall leads to the root: where the value rises, near an end that is almost a second one, a short step would stay.
    bool within = slope < 0.0 && next >= low && next <= high;
    converged = (within && abs(next - x) < BY_PRECISION(1e-6, 1e-10lf)) || high - low < BY_PRECISION(1e-7, 1e-15lf);
    x = within ? next : 0.5 * (low + high);
  }
  return x;
}

// The first root of a quartic that is positive at 0, in [0,1]; -1 where there is none.
//
// Looks at a stretch of it at a time. Its control points have one change of sign: one root, which Newton finds. None: no root, on
// to the next stretch, twice as long. More: the root, if any, is not before the hull reaches 0; look at half the length
// from there. Clipping after T. W. Sederberg, T. Nishita, Curve intersection using Bezier clipping, 1990,
// DOI 10.1016/0010-4485(90)90039-F.
real first_root(real b[5]) {
  real from = 0.0;
  real stretch = 1.0;
  real root = -1.0;
  bool looking = true;
  bool single = false;
  real c0 = b[0], c1 = b[1], c2 = b[2], c3 = b[3], c4 = b[4];
  for (int i = 0; i < BY_PRECISION(64, 160) && looking; ++i) {
    // Control points on [from, to]: de Casteljau at `from`, then at `to`.
    real to = min(from + stretch, 1.0);
    real x = from, y = 1.0 - x;
    c0 = b[0], c1 = b[1], c2 = b[2], c3 = b[3], c4 = b[4];
    c0 = y * c0 + x * c1, c1 = y * c1 + x * c2, c2 = y * c2 + x * c3, c3 = y * c3 + x * c4;
    c0 = y * c0 + x * c1, c1 = y * c1 + x * c2, c2 = y * c2 + x * c3;
    c0 = y * c0 + x * c1, c1 = y * c1 + x * c2;
    c0 = y * c0 + x * c1;
    x = min((to - from) / (1.0 - from), 1.0), y = 1.0 - x;
    c4 = y * c3 + x * c4, c3 = y * c2 + x * c3, c2 = y * c1 + x * c2, c1 = y * c0 + x * c1;
    c4 = y * c3 + x * c4, c3 = y * c2 + x * c3, c2 = y * c1 + x * c2;
    c4 = y * c3 + x * c4, c3 = y * c2 + x * c3;
    c4 = y * c3 + x * c4;

    int changes = int(c1 <= 0.0) + int((c1 > 0.0) != (c2 > 0.0)) + int((c2 > 0.0) != (c3 > 0.0)) + int((c3 > 0.0) != (c4 > 0.0));
    bool reached = c0 <= 0.0;
    single = !reached && changes == 1;
    bool none = !reached && changes == 0;
    // Undecided at the shortest stretch: a tangency within rounding, or a root that `from` has reached.
    bool undecided = !reached && changes > 1 && stretch < BY_PRECISION(1e-7, 1e-15lf);
    root = reached || undecided ? from : root;
    looking = !(reached || single || undecided || (none && to >= 1.0));
    real clip = hull_reaches_zero(c0, c1, c2, c3, c4);
    from = looking ? (none ? to : from + (to - from) * clip) : from;
    stretch = looking ? (none ? 2.0 * stretch : 0.5 * stretch) : stretch;
    looking = looking && from < 1.0;
  }
  return single ? from + min(stretch, 1.0 - from) * only_root(c0, c1, c2, c3, c4) : root;
}

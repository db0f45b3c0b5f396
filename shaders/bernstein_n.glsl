// Polynomials of any degree n = SPLINE_DEGREE in Bernstein form on [0,1].
const int N = SPLINE_DEGREE;

real least_of(real b[N + 1]) {
  real least = b[0];
  for (int i = 1; i <= N; ++i) least = min(least, b[i]);
  return least;
}
// s (b - c).
real[N + 1] scaled_differences(real b[N + 1], real c, real s) {
  for (int i = 0; i <= N; ++i) b[i] = s * (b[i] - c);
  return b;
}

// Where the steepest line from the first control point, which is positive, down to another one reaches 0, or 1. All control points lie
// on or above that line, and with them the polynomial.
real steepest_reaches_zero(real b[N + 1]) {
  real slope = 0.0;
  for (int i = 1; i <= N; ++i) slope = min(slope, (b[i] - b[0]) * (real(N) / real(i)));
  return slope < -b[0] ? -b[0] / slope : 1.0;
}

// The control points on [x,1] of those on [0,1]: de Casteljau. Inner loops run over all of them, so that every index is a constant once
// unrolled.
void keep_end(inout real b[N + 1], real x) {
  real y = 1.0 - x;
  for (int n = N; n > 0; --n)
    for (int i = 0; i < N; ++i) b[i] = i < n ? y * b[i] + x * b[i + 1] : b[i];
}
// The control points on [0,x] of those on [0,1].
void keep_begin(inout real b[N + 1], real x) {
  real y = 1.0 - x;
  for (int n = N; n > 0; --n)
    for (int i = N; i > 0; --i) b[i] = i > N - n ? y * b[i - 1] + x * b[i] : b[i];
}

// The root of a polynomial that changes sign once, from positive at 0: bracketed Newton. With B_i = C(n,i) b_i the value is
// sum B_i x^i (1-x)^(n-i), by Horner's rule in 1-x.
real only_root(real b[N + 1]) {
  real scaled[N + 1];
  real binomial = 1.0;
  for (int i = 0; i <= N; ++i) {
    scaled[i] = binomial * b[i];
    binomial *= real(N - i) / real(i + 1);
  }
  real low = 0.0;
  real high = 1.0;
  real x = b[0] / (b[0] - b[N]);
  bool converged = false;
  for (int k = 0; k < BY_PRECISION(24, 60) && !converged; ++k) {
    real y = 1.0 - x;
    real power = 1.0;
    real f = scaled[0];
    real slope = 0.0;
    for (int i = 1; i <= N; ++i) {
      slope = slope * y - f + real(i) * scaled[i] * power;
      power *= x;
      f = f * y + scaled[i] * power;
    }
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

// The first root of a polynomial that is positive at 0, in [0,1]; -1 where there is none.
//
// Looks at a stretch of it at a time. Its control points have one change of sign: one root, which Newton finds. None: no root, on
// to the next stretch, twice as long. More: the root, if any, is not before the steepest line reaches 0; look at half the length
// from there. Clipping after T. W. Sederberg, T. Nishita, Curve intersection using Bezier clipping, 1990,
// DOI 10.1016/0010-4485(90)90039-F, who clip to the whole hull: of many control points that costs more than it saves.
real first_root(real b[N + 1]) {
  real from = 0.0;
  real stretch = 1.0;
  real root = -1.0;
  bool looking = true;
  bool single = false;
  real c[N + 1] = b;
  for (int k = 0; k < BY_PRECISION(64, 160) && looking; ++k) {
    // Control points on [from, to].
    real to = min(from + stretch, 1.0);
    c = b;
    keep_end(c, from);
    keep_begin(c, min((to - from) / (1.0 - from), 1.0));

    int changes = int(c[1] <= 0.0);
    for (int i = 1; i < N; ++i) changes += int((c[i] > 0.0) != (c[i + 1] > 0.0));
    bool reached = c[0] <= 0.0;
    single = !reached && changes == 1;
    bool none = !reached && changes == 0;
    // Undecided at the shortest stretch: a tangency within rounding, or a root that `from` has reached.
    bool undecided = !reached && changes > 1 && stretch < BY_PRECISION(1e-7, 1e-15lf);
    root = reached || undecided ? from : root;
    looking = !(reached || single || undecided || (none && to >= 1.0));
    real clip = steepest_reaches_zero(c);
    from = looking ? (none ? to : from + (to - from) * clip) : from;
    stretch = looking ? (none ? 2.0 * stretch : 0.5 * stretch) : stretch;
    looking = looking && from < 1.0;
  }
  return single ? from + min(stretch, 1.0 - from) * only_root(c) : root;
}

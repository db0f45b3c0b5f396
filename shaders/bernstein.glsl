// Quartics in Bernstein form on [0,1].

// Where the segment (i, p) .. (j, q) of the control polygon comes down to 0, or 1.
float hull_crossing(float i, float p, float j, float q) { return p > 0.0 && q <= 0.0 ? 0.25 * (i + (j - i) * p / (p - q)) : 1.0; }

// The first root of a quartic that is positive at 0, in [0,1]; -1 where there is none.
//
// The convex hull of the control points bounds the first root from below: cut there (de Casteljau) and look again until the
// signs change once, which means one root, or not at all. Clipping after T. W. Sederberg, T. Nishita,
// Curve intersection using Bezier clipping, 1990, DOI 10.1016/0010-4485(90)90039-F.
float first_root(float b0, float b1, float b2, float b3, float b4) {
  float base = 0.0;
  float width = 1.0;
  bool done = false;
  float root = -1.0;
  int changes = 4;
  for (int i = 0; i < 48 && !done && changes > 1; ++i) {
    bool none = min(min(b1, b2), min(b3, b4)) > 0.0;
    changes = int(b1 <= 0.0) + int((b1 > 0.0) != (b2 > 0.0)) + int((b2 > 0.0) != (b3 > 0.0)) + int((b3 > 0.0) != (b4 > 0.0));
    done = none;
    if (!none && changes > 1) {
      float x = min(min(hull_crossing(0.0, b0, 1.0, b1), hull_crossing(0.0, b0, 2.0, b2)),
                    min(hull_crossing(0.0, b0, 3.0, b3), hull_crossing(0.0, b0, 4.0, b4)));
      x = min(x, min(min(hull_crossing(1.0, b1, 2.0, b2), hull_crossing(1.0, b1, 3.0, b3)), hull_crossing(1.0, b1, 4.0, b4)));
      x = min(x, min(min(hull_crossing(2.0, b2, 3.0, b3), hull_crossing(2.0, b2, 4.0, b4)), hull_crossing(3.0, b3, 4.0, b4)));
      float y = 1.0 - x;
      b0 = y * b0 + x * b1, b1 = y * b1 + x * b2, b2 = y * b2 + x * b3, b3 = y * b3 + x * b4;
      b0 = y * b0 + x * b1, b1 = y * b1 + x * b2, b2 = y * b2 + x * b3;
      b0 = y * b0 + x * b1, b1 = y * b1 + x * b2;
      b0 = y * b0 + x * b1;
      base += width * x;
      width *= y;
      // Within rounding of a root: decided there. (b0 itself may never reach 0.)
      bool converged = x < 1e-6 && b1 <= 0.0;
      root = b0 <= 0.0 || converged || width < 1e-7 ? base : root;
      done = root >= 0.0;
    }
  }
  // Still undecided: a tangency that 48 clips do not part.
  if (!done && changes > 1) root = base;
  if (done || changes > 1 || b4 > 0.0) return root;

  // One change of sign: bracketed Newton on the monomial form.
  float a1 = 4.0 * (b1 - b0);
  float a2 = 6.0 * (b2 - 2.0 * b1 + b0);
  float a3 = 4.0 * (b3 - 3.0 * b2 + 3.0 * b1 - b0);
  float a4 = b4 - 4.0 * b3 + 6.0 * b2 - 4.0 * b1 + b0;
  float low = 0.0;
  float high = 1.0;
  float x = b0 / (b0 - b4);
  bool converged = false;
  for (int i = 0; i < 16 && !converged; ++i) {
    float f = b0 + x * (a1 + x * (a2 + x * (a3 + x * a4)));
    float slope = a1 + x * (2.0 * a2 + x * (3.0 * a3 + x * 4.0 * a4));
    low = f > 0.0 ? x : low;
    high = f > 0.0 ? high : x;
    float next = x - f / slope;
    converged = abs(next - x) < 1e-6;
    next = converged ? clamp(next, 0.0, 1.0) : next;
    x = next >= low && next <= high || converged ? next : 0.5 * (low + high);
  }
  return base + width * x;
}

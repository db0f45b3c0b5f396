#include "render/roots.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace quincunx {
namespace {

constexpr int kMaxDepth = 50;
constexpr int kMaxIterations = 200;

using Bernstein = std::array<double, kMaxDegree + 1>;

bool above(double p) { return p >= 0.0; }

int sign_changes(const Bernstein& b, int degree) {
  int changes = 0;
  for (int i = 0; i < degree; ++i) changes += above(b[i]) != above(b[i + 1]);
  return changes;
}

/// p(x), and its derivative from the last differences of de Casteljau's scheme.
struct ValueAndSlope {
  double value, slope;
};
ValueAndSlope evaluate(Bernstein b, int degree, double x) {
  for (int n = degree; n > 1; --n)
    for (int i = 0; i < n; ++i) b[i] += x * (b[i + 1] - b[i]);
  return {b[0] + x * (b[1] - b[0]), degree * (b[1] - b[0])};
}

/// The one crossing in [0,1] of a polynomial whose ends lie on different sides: Newton's method kept inside a bracket
/// that is halved where Newton is slow. It never steps on 0 or 1, which may be zeros that are not the crossing.
double one_crossing(const Bernstein& b, int degree) {
  const bool first = above(b[0]);
  double low = 0.0, high = 1.0;
  double x = b[0] / (b[0] - b[degree]);
  if (!(x > 0.0 && x < 1.0)) x = 0.5;
  double last_step = 1.0;
  for (int i = 0; i < kMaxIterations; ++i) {
    const ValueAndSlope p = evaluate(b, degree, x);
    (above(p.value) == first ? low : high) = x;
    double next = x - p.value / p.slope;
    const bool inside = next >= low && next <= high && next > 0.0 && next < 1.0;
    if (!inside || std::abs(next - x) > 0.5 * last_step) next = 0.5 * (low + high);
    last_step = std::abs(next - x);
    x = next;
    // 2^-54 of the interval is below the rounding of any place in it.
    if (last_step <= 0x1p-54 || high - low <= 0x1p-54) break;
  }
  return x;
}

/// The left half of `b` in place; returns the right half.
Bernstein halve(Bernstein& b, int degree) {
  Bernstein right{};
  Bernstein work = b;
  for (int n = degree; n >= 0; --n) {
    b[degree - n] = work[0];
    right[n] = work[n];
    for (int i = 0; i < n; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
  }
  return right;
}

/// Crossings of `b`, which stands for the interval [begin, begin + 2^-depth].
void isolate(Bernstein b, int degree, double begin, int depth, std::vector<double>& x) {
  const int changes = sign_changes(b, degree);
  if (changes == 0) return;
  const double width = std::ldexp(1.0, -depth);
  if (changes == 1) {
    x.push_back(begin + width * one_crossing(b, degree));
    return;
  }
  if (depth == kMaxDepth) {
    // Touched from below: there and back. Touched from above: nothing. Ends apart: one crossing.
    const bool odd = changes % 2 == 1;
    if (odd || !above(b[0])) x.insert(x.end(), odd ? 1 : 2, begin + 0.5 * width);
    return;
  }
  const Bernstein right = halve(b, degree);
  isolate(b, degree, begin, depth + 1, x);
  isolate(right, degree, begin + 0.5 * width, depth + 1, x);
}

}  // namespace

void append_crossings(std::span<const double> b, std::vector<double>& x) {
  assert(b.size() >= 2 && b.size() <= kMaxDegree + 1);
  Bernstein copy{};
  std::copy(b.begin(), b.end(), copy.begin());
  isolate(copy, int(b.size()) - 1, 0.0, 0, x);
}

}  // namespace quincunx

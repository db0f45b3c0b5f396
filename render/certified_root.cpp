#include "render/certified_root.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quincunx {
namespace {

constexpr double kLeastStep = 0x1p-43, kFlatStep = 0x1p-13;

/// The shortest step: longer where neither value nor slope is told from 0.
double least_step(const ValueAndSlope& g, double rounding) {
  const double flat = 4.0 * rounding;
  return std::abs(g.value) <= flat && std::abs(g.slope) * kFlatStep <= flat ? kFlatStep : kLeastStep;
}

/// How far from a place the function certainly keeps its side.
double safe_step(const ValueAndSlope& g, double curvature) {
  const double v = std::abs(g.value), p = g.value >= 0.0 ? g.slope : -g.slope;
  const double root = std::sqrt(p * p + 2.0 * curvature * v);
  if (p < 0.0) return 2.0 * v / (root - p);  // the same without cancellation
  return curvature > 0.0 ? (p + root) / curvature : std::numeric_limits<double>::infinity();
}

}  // namespace

void append_crossings(const std::function<ValueAndSlope(double)>& g, double curvature, double rounding, double end, bool& above, std::vector<double>& t) {
  for (double x = 0.0;;) {
    const ValueAndSlope here = g(x);
    if ((here.value >= 0.0) != above) t.push_back(x);
    above = here.value >= 0.0;
    if (x >= end) return;
    x = std::min(x + std::max(safe_step(here, curvature), least_step(here, rounding)), end);
  }
}

}  // namespace quincunx

#include "render/transfer_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kLargest = 1e37;

/// The function of `points` at `value`; `member` is what is interpolated.
template <class Point, class Result>
Result interpolate(const std::vector<Point>& points, Result Point::*member, double value) {
  assert(!points.empty());
  const auto next = std::ranges::upper_bound(points, value, {}, &Point::value);
  if (next == points.begin()) return points.front().*member;
  if (next == points.end()) return points.back().*member;
  const Point &a = next[-1], &b = *next;
  const double s = (value - a.value) / (b.value - a.value);
  return (1.0 - s) * (a.*member) + s * (b.*member);
}

template <class Point>
std::vector<double> values_of(const std::vector<Point>& points) {
  std::vector<double> values;
  for (const Point& point : points) values.push_back(point.value);
  return values;
}

/// False for NaN.
bool is_part(double x) { return x >= 0.0 && x <= 1.0; }

}  // namespace

glm::dvec3 TransferFunction::color(double value) const { return interpolate(colors, &ColorPoint::color, value); }
double TransferFunction::opacity(double value) const { return interpolate(opacities, &OpacityPoint::opacity, value); }
double TransferFunction::low() const { return std::min(colors.front().value, opacities.front().value); }
double TransferFunction::high() const { return std::max(colors.back().value, opacities.back().value); }

void check_values(std::span<const double> values, std::string_view what, std::string_view list) {
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!(std::abs(values[n]) <= kLargest))
      throw InputError(fmt::format("{}: point {} of \"{}\" has the value {}; expected a number within +-{}", what, n, list, values[n], kLargest));
    if (n > 0 && values[n] <= values[n - 1])
      throw InputError(fmt::format("{}: point {} of \"{}\" has the value {} after {}; expected ascending values, no two alike", what, n, list,
                                   values[n], values[n - 1]));
  }
}

void check_transfer_function(const TransferFunction& function, std::string_view what) {
  if (function.colors.empty())
    throw InputError(fmt::format("{}: \"colors\" has no point; expected at least one", what));
  if (function.opacities.size() < 2)
    throw InputError(fmt::format("{}: \"opacities\" has {} points; expected at least two", what, function.opacities.size()));
  if (!(function.unit >= 0.0 && function.unit <= kLargest))
    throw InputError(fmt::format("{}: \"unit\" is {}; expected a length above 0", what, function.unit));
  check_values(values_of(function.colors), what, "colors");
  check_values(values_of(function.opacities), what, "opacities");
  for (const auto& [value, c] : function.colors)
    if (!is_part(c.r) || !is_part(c.g) || !is_part(c.b))
      throw InputError(fmt::format("{}: the colour at {} is {} {} {}; expected red, green and blue from 0 to 1", what, value, c.r, c.g, c.b));
  for (const auto& [value, opacity] : function.opacities)
    if (!is_part(opacity))
      throw InputError(fmt::format("{}: the opacity at {} is {}; expected a number from 0 to 1", what, value, opacity));
}

}  // namespace quincunx

#include "render/transfer_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kMostEntries = 8192.0;  // of --tf-entries

/// The opacity of a stretch of `units` unit lengths.
double stretch_opacity(double opacity, double units) {
  return -std::expm1(units * std::log1p(-std::min(opacity, 1.0 - 0x1p-24)));
}

double entry_value(const TransferTable& table, std::size_t n) {
  return double(table.low) + (double(table.high) - double(table.low)) * double(n) / double(table.entries.size() - 1);
}

/// Whether an entry's value lies between these two.
bool has_entry_between(const TransferTable& table, double first, double last) {
  const double x = (first - double(table.low)) / (double(table.high) - double(table.low)) * double(table.entries.size() - 1);
  const auto below = std::size_t(std::max(0.0, std::floor(x)));
  // The first entry above `first` is below + 1, or by rounding one of its neighbours.
  for (std::size_t n = below; n < std::min(below + 3, table.entries.size()); ++n)
    if (const double value = entry_value(table, n); value > first && value < last) return true;
  return false;
}

/// Throws where the function has opacity only between two values that lie between two entries. A stretch of values with opacity that
/// does not end meets the first or the last entry.
void check_stretches(const TransferFunction& function, const TransferTable& table) {
  const auto& points = function.opacities;
  const auto clear = [](const TransferFunction::OpacityPoint& point) { return point.opacity == 0.0; };
  auto first = std::find_if(points.begin(), points.end(), clear);
  while (first != points.end()) {
    const auto last = std::find_if(first + 1, points.end(), clear);
    if (last == points.end()) return;
    if (last != first + 1 && !has_entry_between(table, first->value, last->value)) {
      const double wanted = std::floor((double(table.high) - double(table.low)) / (last->value - first->value)) + 2.0;
      throw InputError(fmt::format(
          "--tf-entries: none of {} entries meets the opacity between the values {} and {}; expected {}", table.entries.size(), first->value,
          last->value, wanted <= kMostEntries ? fmt::format("at least {}", wanted) : "a transfer function with a wider stretch there"));
    }
    first = last;
  }
}

}  // namespace

TransferTable bake(const TransferFunction& function, int entries, double length, double unit) {
  assert(entries >= 2 && length > 0.0 && unit > 0.0);
  TransferTable table;
  table.low = float_below(function.low());
  table.high = float_above(function.high());
  table.entries.resize(std::size_t(entries));
  check_stretches(function, table);

  const double units = length / (function.unit > 0.0 ? function.unit : unit);
  for (std::size_t n = 0; n < table.entries.size(); ++n) {
    const double value = entry_value(table, n), alpha = stretch_opacity(function.opacity(value), units);
    table.entries[n] = glm::vec4(glm::dvec4(alpha * function.color(value), alpha));
  }
  return table;
}

float float_below(double x) {
  const float nearest = float(x);
  return double(nearest) <= x ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
float float_above(double x) { return -float_below(-x); }

}  // namespace quincunx

#include "render/seen_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "accel/opaque_ranges.h"
#include "render/transfer_table.h"

namespace quincunx {
namespace {

constexpr std::size_t kMostRanges = 254;
constexpr double kMostIsovalue = 1e30;  // beyond, polynomials of it would overflow; coefficients are below 2^65


constexpr double kMargin = 1.0 / 64.0;  // entries; more than a look-up in floats is off
constexpr double kLargest = std::numeric_limits<double>::max();

/// Of a table of entries that single samples look up. An entry counts however thin the volume is: as if stretches were endless.
std::vector<ValueRange> post_values(const DirectVolume& volume) {
  TransferFunction function = volume.function;
  function.unit = 1.0;
  const TransferTable table = bake(function, volume.table_entries(), kLargest, 1.0);
  std::vector<float> alpha;
  for (const glm::vec4& entry : table.entries) alpha.push_back(entry.a);
  return opaque_ranges(alpha, table.low, table.high);
}

/// Of a pre-integrated table: from the entry before a stretch of values with opacity to the one after. Between two entries that both lie
/// before it, or both behind, no look-up meets it.
std::vector<ValueRange> pre_integrated_values(const DirectVolume& volume) {
  const auto& points = volume.function.opacities;
  const double low = float_below(volume.function.low()), high = float_above(volume.function.high());
  const double interval = (high - low) / (volume.table_entries() - 1);
  std::vector<ValueRange> ranges;
  const auto add = [&](double from, double to) {
    ranges.push_back({from == -kLargest ? from : low + interval * (std::floor((from - low) / interval) - kMargin),
                      to == kLargest ? to : low + interval * (std::ceil((to - low) / interval) + kMargin)});
  };
  if (points.front().opacity > 0.0) add(-kLargest, points.front().value);
  for (std::size_t n = 1; n < points.size(); ++n)
    if (points[n - 1].opacity > 0.0 || points[n].opacity > 0.0) add(points[n - 1].value, points[n].value);
  if (points.back().opacity > 0.0) add(points.back().value, kLargest);
  return ranges;
}

}  // namespace

std::vector<ValueRange> seen_values(const Scene& scene) {
  std::vector<ValueRange> ranges = ranges_of(isovalues_of(visible_surfaces(scene)));
  if (scene.volume) {
    const DirectVolume& volume = *scene.volume;
    const std::vector<ValueRange> opaque = volume.classify == Classify::post ? post_values(volume) : pre_integrated_values(volume);
    ranges.insert(ranges.end(), opaque.begin(), opaque.end());
  }
  return joined(merged(std::move(ranges)), kMostRanges);
}

float kernel_isovalue(double isovalue, const ValueUnit& unit) { return float(std::clamp(unit.number(isovalue), -kMostIsovalue, kMostIsovalue)); }

std::vector<ValueRange> numbers_of(std::vector<ValueRange> values, const ValueUnit& unit) {
  if (unit.plain()) return values;
  for (ValueRange& range : values) {
    if (range.low == range.high) {
      range.low = range.high = kernel_isovalue(range.low, unit);
    } else {
      // Two roundings each.
      range.low = std::nextafter(std::nextafter(unit.number(range.low), -kLargest), -kLargest);
      range.high = std::nextafter(std::nextafter(unit.number(range.high), kLargest), kLargest);
    }
  }
  return merged(std::move(values));
}

}  // namespace quincunx

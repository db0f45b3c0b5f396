#include "render/seen_values.h"

#include <algorithm>
#include <cmath>

#include "accel/opaque_ranges.h"
#include "render/transfer_table.h"

namespace quincunx {
namespace {

constexpr std::size_t kMostRanges = 254;

/// Of a table of entries that single samples look up.
std::vector<float> post_mask(const DirectVolume& volume) {
  std::vector<float> alpha;
  for (const glm::vec4& entry : bake(volume.function, volume.table_entries(), 1.0, 1.0).entries) alpha.push_back(entry.a);
  return alpha;
}

/// Of a pre-integrated table: the entries that bound, or lie in, a stretch of values with opacity. A cell between two entries is looked up
/// together with its neighbours, so that a value matters from the entry before such a stretch to the one after.
std::vector<float> pre_integrated_mask(const DirectVolume& volume) {
  const auto& points = volume.function.opacities;
  const double low = float_below(volume.function.low()), high = float_above(volume.function.high());
  const int last = volume.table_entries() - 1;
  const auto place = [&](double value) { return (value - low) / (high - low) * last; };
  std::vector<float> mask(std::size_t(last) + 1);
  const auto mark = [&](double from, double to) {
    for (int n = std::max(int(std::floor(from)), 0); n <= std::min(int(std::ceil(to)), last); ++n) mask[std::size_t(n)] = 1.0f;
  };
  if (points.front().opacity > 0.0) mark(0.0, place(points.front().value));
  for (std::size_t n = 1; n < points.size(); ++n)
    if (points[n - 1].opacity > 0.0 || points[n].opacity > 0.0) mark(place(points[n - 1].value), place(points[n].value));
  if (points.back().opacity > 0.0) mark(place(points.back().value), last);
  return mask;
}

}  // namespace

std::vector<ValueRange> seen_values(const Scene& scene) {
  std::vector<ValueRange> ranges = ranges_of(isovalues_of(visible_surfaces(scene)));
  if (scene.volume) {
    const DirectVolume& volume = *scene.volume;
    const std::vector<float> mask = volume.classify == Classify::post ? post_mask(volume) : pre_integrated_mask(volume);
    const std::vector<ValueRange> opaque = opaque_ranges(mask, float_below(volume.function.low()), float_above(volume.function.high()));
    ranges.insert(ranges.end(), opaque.begin(), opaque.end());
  }
  return joined(merged(std::move(ranges)), kMostRanges);
}

}  // namespace quincunx

#include "accel/thresholds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr int kSteps = 65536;
constexpr std::size_t kMostRanges = 254;

}  // namespace

Thresholds::Thresholds(const ValueScale& scale, std::span<const ValueRange> ranges) : below_(kSteps), up_to_(kSteps) {
  if (ranges.size() > kMostRanges)
    throw InputError(fmt::format("--iso: found {} isovalues, expected at most {}", ranges.size(), kMostRanges));
  assert(std::ranges::is_sorted(ranges, {}, &ValueRange::low));

  // value(q) never descends: walk q and the ranges together.
  std::size_t below = 0, up_to = 0;
  for (int q = 0; q < kSteps; ++q) {
    const double value = scale.value(std::uint16_t(q));
    while (below < ranges.size() && ranges[below].high < value) ++below;
    while (up_to < ranges.size() && ranges[up_to].low <= value) ++up_to;
    below_[std::size_t(q)] = std::uint8_t(below);
    up_to_[std::size_t(q)] = std::uint8_t(up_to);
  }
  for (std::size_t n = 0; n < ranges.size(); ++n) {
    // The first q above range n, and the first at or above its beginning.
    const auto above = std::partition_point(below_.begin(), below_.end(), [n](std::uint8_t b) { return b <= n; });
    const auto reached = std::partition_point(up_to_.begin(), up_to_.end(), [n](std::uint8_t u) { return u <= n; });
    if (above == below_.begin() || reached == up_to_.end()) continue;
    windows_.push_back({std::uint16_t(above - below_.begin() - 1), std::uint16_t(reached - up_to_.begin())});
  }
}

}  // namespace quincunx

#include "accel/thresholds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr int kSteps = 65536;
constexpr std::size_t kMostIsovalues = 254;

}  // namespace

Thresholds::Thresholds(const CellBounds& scale, std::span<const double> isovalues) : below_(kSteps), up_to_(kSteps) {
  if (isovalues.size() > kMostIsovalues)
    throw InputError(fmt::format("--iso: found {} isovalues, expected at most {}", isovalues.size(), kMostIsovalues));
  assert(std::is_sorted(isovalues.begin(), isovalues.end()));

  // value(q) never descends: walk q and the isovalues together.
  std::size_t below = 0, up_to = 0;
  for (int q = 0; q < kSteps; ++q) {
    const double value = scale.value(std::uint16_t(q));
    while (below < isovalues.size() && isovalues[below] < value) ++below;
    while (up_to < isovalues.size() && isovalues[up_to] <= value) ++up_to;
    below_[std::size_t(q)] = std::uint8_t(below);
    up_to_[std::size_t(q)] = std::uint8_t(up_to);
  }
  for (std::size_t n = 0; n < isovalues.size(); ++n) {
    // The first q above isovalue n, and the first at or above it.
    const auto above = std::partition_point(below_.begin(), below_.end(), [n](std::uint8_t b) { return b <= n; });
    const auto reached = std::partition_point(up_to_.begin(), up_to_.end(), [n](std::uint8_t u) { return u <= n; });
    if (above == below_.begin() || reached == up_to_.end()) continue;
    windows_.push_back({std::uint16_t(above - below_.begin() - 1), std::uint16_t(reached - up_to_.begin())});
  }
}

}  // namespace quincunx

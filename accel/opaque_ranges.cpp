#include "accel/opaque_ranges.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace quincunx {

std::vector<ValueRange> opaque_ranges(std::span<const float> alpha, double low, double high) {
  assert(alpha.size() >= 2 && low < high);
  constexpr double kMargin = 1.0 / 64.0, kLargest = std::numeric_limits<double>::max();
  const double last = double(alpha.size() - 1);
  const auto value = [&](double entry) { return low + (high - low) * (entry / last); };

  std::vector<ValueRange> ranges;
  for (std::size_t n = 0; n < alpha.size(); ++n) {
    if (alpha[n] == 0.0f) continue;
    const std::size_t first = n;
    while (n + 1 < alpha.size() && alpha[n + 1] != 0.0f) ++n;
    ranges.push_back({first == 0 ? -kLargest : value(double(first) - 1.0 - kMargin),
                      n + 1 == alpha.size() ? kLargest : value(double(n) + 1.0 + kMargin)});
  }
  return merged(std::move(ranges));  // ranges with one entry of 0 between them meet there
}

std::vector<ValueRange> joined(std::span<const ValueRange> ranges, std::size_t most) {
  assert(most >= 1);
  if (ranges.size() <= most) return {ranges.begin(), ranges.end()};
  // Gap n lies before range n. The widest stay.
  std::vector<std::size_t> gaps;
  for (std::size_t n = 1; n < ranges.size(); ++n) gaps.push_back(n);
  const auto wider = [&](std::size_t a, std::size_t b) { return ranges[a].low - ranges[a - 1].high > ranges[b].low - ranges[b - 1].high; };
  std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(most - 1), gaps.end(), wider);
  gaps.resize(most - 1);
  std::ranges::sort(gaps);

  std::vector<ValueRange> all{ranges.front()};
  for (const std::size_t gap : gaps) {
    all.back().high = ranges[gap - 1].high;
    all.push_back(ranges[gap]);
  }
  all.back().high = ranges.back().high;
  return all;
}

}  // namespace quincunx

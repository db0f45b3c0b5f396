#include "accel/value_range.h"

#include <algorithm>
#include <cassert>

namespace quincunx {

std::vector<ValueRange> merged(std::vector<ValueRange> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const ValueRange& a, const ValueRange& b) { return a.low < b.low; });
  std::vector<ValueRange> all;
  for (const ValueRange& range : ranges) {
    assert(range.low <= range.high);
    if (!all.empty() && range.low <= all.back().high) {
      all.back().high = std::max(all.back().high, range.high);
    } else {
      all.push_back(range);
    }
  }
  return all;
}

std::vector<ValueRange> ranges_of(std::span<const double> isovalues) {
  std::vector<ValueRange> ranges;
  for (const double v : isovalues) ranges.push_back({v, v});
  return ranges;
}

}  // namespace quincunx

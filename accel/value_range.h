// Which values can be seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace quincunx {

/// A closed range of values: one isovalue (low = high), or values to which a transfer function gives opacity.
/// Where several are wanted, they ascend and are disjoint.
struct ValueRange {
  double low = 0.0, high = 0.0;
  bool operator==(const ValueRange&) const = default;
};

/// Any ranges (low <= high) as ascending, disjoint ones of the same union.
std::vector<ValueRange> merged(std::vector<ValueRange> ranges);

/// Isovalues, ascending, as ranges.
std::vector<ValueRange> ranges_of(std::span<const double> isovalues);

/// 16-bit numbers for values: value(q) = low + q * step, exactly as computed in double.
struct ValueScale {
  double low = 0.0, step = 1.0;
  double value(std::uint16_t q) const { return low + double(q) * step; }
};

}  // namespace quincunx

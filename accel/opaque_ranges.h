// The values to which a table gives opacity.
#pragma once

#include <span>
#include <vector>

#include "accel/value_range.h"

namespace quincunx {

/// Where a table of at least two entries, the n-th of N at low + n (high - low) / (N - 1), may be above 0 when interpolated linearly and
/// constant beyond its ends: the ranges reach from the entry before the first above 0 to the one after the last, and 1/64 of the
/// way to the next entry further, which is more than a look-up in 32-bit floats is off. Where the first or last entry is above 0 they
/// end at -+ the largest double. `alpha` >= 0, low < high. Ascending and disjoint; none where all entries are 0.
std::vector<ValueRange> opaque_ranges(std::span<const float> alpha, double low, double high);

/// At most `most` >= 1 ranges that hold all of `ranges` (ascending, disjoint): the closest neighbours are joined.
std::vector<ValueRange> joined(std::span<const ValueRange> ranges, std::size_t most);

}  // namespace quincunx

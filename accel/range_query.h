// Does an interval of values meet one that can be seen? Three ways to ask a row of entries.
//
// `table` and `irt` are the full table and the iterative range tree of I. Wald, *Computing minima and maxima of subarrays*, in Ray
// Tracing Gems, 2019, DOI 10.1007/978-1-4842-4427-2_5, sections 5.2 and 5.5. There they hold the largest opacity; as only whether there
// is any is asked here, a bit and a byte do. `intervals` is ours: what can be seen is a few runs of entries, and two counts of
// them answer in constant time from memory that grows with the entries alone.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/skip_config.h"
#include "accel/thresholds.h"

namespace quincunx {

/// Each is made of a row of 1 to 65536 entries, and answers any(first, last): is one of entries first..last not 0? (first <= last)

/// Counts runs of set entries: such as begin at or before an entry, and such as end before it.
class IntervalQuery {
 public:
  explicit IntervalQuery(std::span<const std::uint8_t> set);
  bool any(std::size_t first, std::size_t last) const { return begun_[last] > ended_[first]; }
  std::size_t bytes() const { return 2 * sizeof(std::uint16_t) * begun_.size(); }

 private:
  std::vector<std::uint16_t> begun_, ended_;
};

/// A bit for every answer.
class TableQuery {
 public:
  explicit TableQuery(std::span<const std::uint8_t> set);
  bool any(std::size_t first, std::size_t last) const { return bits_[first * words_ + last / 64] >> (last % 64) & 1; }
  std::size_t bytes() const { return sizeof(std::uint64_t) * bits_.size(); }

 private:
  std::size_t words_;  ///< of a row, one for each `first`
  std::vector<std::uint64_t> bits_;
};

/// A binary tree: node n is set where 2n or 2n + 1 is, and entry k is node size + k. The query climbs from both ends of the interval
/// until they meet.
class TreeQuery {
 public:
  explicit TreeQuery(std::span<const std::uint8_t> set);
  bool any(std::size_t first, std::size_t last) const {
    std::size_t a = first + nodes_.size() / 2, b = last + nodes_.size() / 2 + 1;  // nodes a <= n < b are still to be asked
    for (; a < b; a /= 2, b /= 2) {
      if (a % 2 == 1 && nodes_[a++]) return true;
      if (b % 2 == 1 && nodes_[--b]) return true;
    }
    return false;
  }
  std::size_t bytes() const { return nodes_.size(); }

 private:
  std::vector<std::uint8_t> nodes_;
};

/// Calls `use` with the query of that kind over `set`: the one list of them.
template <class Use>
decltype(auto) with_range_query(RangeQueryKind kind, std::span<const std::uint8_t> set, const Use& use) {
  switch (kind) {
    case RangeQueryKind::table: return use(TableQuery(set));
    case RangeQueryKind::irt: return use(TreeQuery(set));
    case RangeQueryKind::intervals: break;
  }
  return use(IntervalQuery(set));
}

/// The 16-bit numbers of bounds as a row of entries, 16 numbers each: entry n is set where a range meets a value from that of number
/// 16 n to that of the number after its last, so that no value between two entries is left out.
constexpr int kNumbersOfAnEntry = 16;
std::vector<std::uint8_t> visible_entries(const Thresholds& thresholds);

/// Calls `use` with a function of two 16-bit numbers, min and max: may the values between them, if there are any, meet a range? `intervals` compares the
/// numbers themselves, exactly; the others look up entries and hold a little more to be visible.
template <class Use>
decltype(auto) with_range_test(RangeQueryKind kind, const Thresholds& thresholds, const Use& use) {
  if (kind == RangeQueryKind::intervals)
    return use([&](std::uint16_t min, std::uint16_t max) { return thresholds.touches(min, max); });
  return with_range_query(kind, visible_entries(thresholds), [&](const auto& query) {
    return use([&](std::uint16_t min, std::uint16_t max) { return min <= max && query.any(min / kNumbersOfAnEntry, max / kNumbersOfAnEntry); });
  });
}

}  // namespace quincunx

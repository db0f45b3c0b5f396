// The range queries (accel/range_query.h) against each other, on rows of entries as transfer functions have them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "accel/skip_config.h"

namespace quincunx {

constexpr std::array<RangeQueryKind, 3> kRangeQueryKinds{RangeQueryKind::intervals, RangeQueryKind::table, RangeQueryKind::irt};
/// "intervals", "table", "irt".
std::string_view range_query_name(RangeQueryKind kind);

/// Blocks of the grid that is pre-classified: 64^3.
constexpr std::size_t kGridBlocks = 64 * 64 * 64;

/// One kind of query over one row.
struct RangeCost {
  std::size_t bytes = 0;
  std::vector<double> build_ms;  ///< one a round
  std::vector<double> query_ms;  ///< a million of them, one a round
  std::vector<double> grid_ms;   ///< of a pre-classified grid of kGridBlocks blocks: the query built, and asked for each; one a round
};

/// What was measured on one row.
struct RangeLine {
  int entries = 0, visible = 0;  ///< of the row, and those with opacity
  std::uint64_t queries = 0, met = 0;
  std::array<RangeCost, 3> costs;  ///< in the order of kRangeQueryKinds
};

/// A row of `entries` with opacity in eight stretches, which cover a quarter of it; the same every time.
std::vector<std::uint8_t> made_up_row(int entries);

/// An interval of entries, first <= last.
struct EntryInterval {
  std::uint16_t first, last;
};
/// Intervals of a row as blocks of a volume have them, many short and a few long; the same every time.
std::vector<EntryInterval> made_up_intervals(int entries, std::size_t count);

/// Builds every query `rounds` times over made_up_row and asks it `queries` >= 1 questions, in turns. Throws std::logic_error where two
/// kinds answer differently.
RangeLine measure_ranges(int entries, std::size_t queries, int rounds);

}  // namespace quincunx

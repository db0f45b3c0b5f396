#include "bench/ranges_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "accel/range_query.h"
#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

/// How many intervals met something, and how many blocks of the grid.
struct Met {
  std::uint64_t intervals = 0, blocks = 0;
  bool operator==(const Met&) const = default;
};

/// Builds and asks one kind once.
Met measure(RangeQueryKind kind, const std::vector<std::uint8_t>& row, const std::vector<EntryInterval>& intervals, RangeCost& cost) {
  const Stopwatch building;
  return with_range_query(kind, row, [&](const auto& query) {
    cost.build_ms.push_back(building.ms());
    cost.bytes = query.bytes();
    const Stopwatch asking;
    Met met;
    for (const auto [first, last] : intervals) met.intervals += query.any(first, last);
    cost.query_ms.push_back(asking.ms() * 1e6 / double(intervals.size()));
    const Stopwatch classifying;
    std::vector<std::uint8_t> grid(kGridBlocks);
    for (std::size_t n = 0; n < grid.size(); ++n) {
      const auto [first, last] = intervals[n % intervals.size()];
      grid[n] = query.any(first, last);
    }
    cost.grid_ms.push_back(cost.build_ms.back() + classifying.ms());
    met.blocks = std::uint64_t(std::ranges::count(grid, 1));
    return met;
  });
}

}  // namespace

std::string_view range_query_name(RangeQueryKind kind) {
  switch (kind) {
    case RangeQueryKind::intervals: return "intervals";
    case RangeQueryKind::table: return "table";
    case RangeQueryKind::irt: return "irt";
  }
  return "";
}

std::vector<std::uint8_t> made_up_row(int entries) {
  std::vector<std::uint8_t> row(static_cast<std::size_t>(entries), 0);
  for (int n = 0; n < entries; ++n) row[std::size_t(n)] = n * 8 % entries >= entries * 3 / 4;
  return row;
}

std::vector<EntryInterval> made_up_intervals(int entries, std::size_t count) {
  std::mt19937 random(1);
  const auto part = [&] { return double(random()) / 4294967296.0; };
  std::vector<EntryInterval> intervals;
  for (std::size_t n = 0; n < count; ++n) {
    const int first = int(part() * entries), length = int(std::pow(part(), 4.0) * entries);
    intervals.push_back({std::uint16_t(first), std::uint16_t(std::min(entries - 1, first + length))});
  }
  return intervals;
}

RangeLine measure_ranges(int entries, std::size_t queries, int rounds) {
  const std::vector<std::uint8_t> row = made_up_row(entries);
  const std::vector<EntryInterval> intervals = made_up_intervals(entries, queries);
  RangeLine line{.entries = entries, .visible = int(std::ranges::count(row, 1)), .queries = queries, .met = 0, .costs = {}};
  Met first;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t n = 0; n < kRangeQueryKinds.size(); ++n) {
      const Met met = measure(kRangeQueryKinds[n], row, intervals, line.costs[n]);
      if (round == 0 && n == 0) first = met;
      if (met != first)
        throw std::logic_error(fmt::format("{} of {} entries: {} intervals and {} blocks meet opacity, {} and {} by counting runs",
                                           range_query_name(kRangeQueryKinds[n]), entries, met.intervals, met.blocks, first.intervals, first.blocks));
    }
  line.met = first.intervals;
  return line;
}

}  // namespace quincunx

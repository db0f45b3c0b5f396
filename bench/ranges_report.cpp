#include "bench/ranges_report.h"

#include <fmt/format.h>

#include "bench/timing.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Table ranges_table(const RangesReport& report) {
  Table table{.headings = {"entries"}, .rows = {}, .left = 0};
  for (const std::string_view what : {"build us", "query ms", "grid ms", "KiB"})
    for (const RangeQueryKind kind : kRangeQueryKinds) table.headings.push_back(fmt::format("{}, {}", range_query_name(kind), what));
  for (const RangeLine& line : report.lines) {
    std::vector<std::string> row{fmt::format("{}", line.entries)};
    for (const RangeCost& cost : line.costs) row.push_back(three_digits(1000.0 * spread(cost.build_ms).median));
    for (const RangeCost& cost : line.costs) row.push_back(three_digits(spread(cost.query_ms).median));
    for (const RangeCost& cost : line.costs) row.push_back(three_digits(spread(cost.grid_ms).median));
    for (const RangeCost& cost : line.costs) row.push_back(three_digits(double(cost.bytes) / 1024.0));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string ranges_caption(const RangesReport& report) {
  const RangeLine& line = report.lines.front();
  return fmt::format(
      "Whether an interval meets an entry with opacity, asked in three ways: counts of runs, the full table and the iterative range tree (Wald "
      "2019), these with a bit and a byte for each of their numbers. Building in microseconds, a million queries in ms, a pre-classified grid of 64^3 blocks (the query built, and asked for each block) in ms, medians of {} round{} in turns; {} "
      "made-up intervals, {:.0f} % of which meet one of the {:.0f} % of the entries with opacity; one thread, {}.",
      report.rounds, report.rounds == 1 ? "" : "s", line.queries, 100.0 * double(line.met) / double(line.queries),
      100.0 * double(line.visible) / double(line.entries), machine_text(report.machine));
}

Json ranges_json(const RangesReport& report) {
  Json json{{"measurement", "ranges"}, {"repeat", report.rounds}, {"processor", report.machine.processor}, {"cores", report.machine.cores}};
  for (const RangeLine& line : report.lines) {
    Json row{{"entries", line.entries}, {"visible", line.visible}, {"queries", line.queries}, {"met", line.met}};
    for (std::size_t n = 0; n < line.costs.size(); ++n)
      row[std::string(range_query_name(kRangeQueryKinds[n]))] = {{"bytes", line.costs[n].bytes},
                                                                 {"build_ms", spread_json(spread(line.costs[n].build_ms))},
                                                                 {"query_ms_per_million", spread_json(spread(line.costs[n].query_ms))},
                                                                 {"grid_ms", spread_json(spread(line.costs[n].grid_ms))}};
    json["rows"].push_back(std::move(row));
  }
  return json;
}

}  // namespace quincunx

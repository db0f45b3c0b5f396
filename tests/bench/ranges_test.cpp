#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/ranges_report.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

TEST(RangesMeasure, AsksARowWithEightStretchesOfOpacity) {
  for (const int entries : {64, 256, 8192}) {
    const std::vector<std::uint8_t> row = made_up_row(entries);
    ASSERT_EQ(row.size(), std::size_t(entries));
    int stretches = row[0];
    for (std::size_t n = 1; n < row.size(); ++n) stretches += row[n] && !row[n - 1];
    EXPECT_EQ(stretches, 8);
    EXPECT_EQ(std::ranges::count(row, 1), entries / 4);
  }
}

TEST(RangesMeasure, AsksIntervalsOfAllLengthsInsideTheRow) {
  const std::vector<EntryInterval> intervals = made_up_intervals(1000, 20000);
  ASSERT_EQ(intervals.size(), 20000u);
  int single = 0, longer = 0;
  for (const auto [first, last] : intervals) {
    ASSERT_LE(first, last);
    ASSERT_LT(last, 1000);
    single += first == last;
    longer += last - first > 300;
  }
  EXPECT_GT(single, 1000);
  EXPECT_GT(longer, 1000);
}

TEST(RangesMeasure, CountsWhatAScanOfTheRowCounts) {
  const RangeLine line = measure_ranges(300, 5000, 2);
  const std::vector<std::uint8_t> row = made_up_row(300);
  std::uint64_t met = 0;
  for (const auto [first, last] : made_up_intervals(300, 5000))
    met += std::any_of(row.begin() + first, row.begin() + last + 1, [](std::uint8_t s) { return s != 0; });
  EXPECT_EQ(line.met, met);
  EXPECT_EQ(line.queries, 5000u);
  EXPECT_EQ(line.visible, std::ranges::count(row, 1));
  for (const RangeCost& cost : line.costs) {
    EXPECT_GT(cost.bytes, 0u);
    EXPECT_EQ(cost.build_ms.size(), 2u);
    EXPECT_EQ(cost.query_ms.size(), 2u);
    EXPECT_EQ(cost.grid_ms.size(), 2u);
    EXPECT_GT(*std::ranges::min_element(cost.query_ms), 0.0);
  }
}

TEST(RangesReport, ShowsMediansInMicrosecondsMillisecondsAndKibibytes) {
  RangesReport report{.rounds = 3, .machine = {"", "", "a processor", 3}, .lines = {}};
  report.lines.push_back({.entries = 512, .visible = 128, .queries = 1000, .met = 400, .costs = {}});
  report.lines[0].costs = {RangeCost{2048, {0.002, 0.001, 0.005}, {3, 1, 2}, {7, 6, 8}}, RangeCost{32768, {0.25, 0.5, 0.75}, {4, 4, 4}, {9, 9, 9}},
                           RangeCost{1024, {0.01, 0.01, 0.03}, {20, 10, 30}, {11, 12, 12}}};
  const Table table = ranges_table(report);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_THAT(table.rows[0], ElementsAre("512", "2", "500", "10", "2", "4", "20", "7", "9", "12", "2", "32", "1"));
  EXPECT_EQ(table.headings.size(), table.rows[0].size());
  EXPECT_EQ(table.headings[2], "table, build us");
  EXPECT_THAT(ranges_caption(report), HasSubstr("40 % of which meet one of the 25 % of the entries"));
  EXPECT_THAT(ranges_caption(report), HasSubstr("on 3 cores of a processor"));
}

TEST(RangesProgram, MeasuresEveryNumberOfEntriesAndWritesThemDown) {
  const test::TemporaryFolder folder;
  const test::Outcome outcome =
      test::run({"ranges", "--entries", "256,100", "--queries", "1000", "--repeat", "3", "--markdown", "--json", folder / "ranges.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<std::string> lines = test::lines(outcome.out);
  ASSERT_EQ(lines.size(), 6u);  // heading, rule, two rows, an empty line, the caption
  EXPECT_THAT(lines[2], HasSubstr(" 256 |"));
  EXPECT_THAT(lines[5], HasSubstr("medians of 3 rounds in turns; 1000 made-up intervals"));
  const Json report = Json::parse(test::read_file(folder / "ranges.json"));
  EXPECT_EQ(report["measurement"], "ranges");
  ASSERT_EQ(report["rows"].size(), 2u);
  EXPECT_EQ(report["rows"][1]["entries"], 100);
  for (const Json& row : report["rows"])
    for (const RangeQueryKind kind : kRangeQueryKinds) {
      const Json& cost = row[std::string(range_query_name(kind))];
      EXPECT_GT(cost["bytes"], 0);
      EXPECT_GT(cost["query_ms_per_million"]["median"], 0.0);
      EXPECT_GT(cost["grid_ms"]["median"], cost["build_ms"]["p5"]);
      EXPECT_LE(cost["build_ms"]["p5"], cost["build_ms"]["p95"]);
    }
}

TEST(RangesProgram, RefusesBadInputInOneLine) {
  for (const auto& [flag, value] : {std::pair{"--entries", "1"}, {"--entries", "100,x"}, {"--entries", "20000"}, {"--queries", "0"}, {"--repeat", "-1"}}) {
    const test::Outcome outcome = test::run({"ranges", flag, value});
    EXPECT_EQ(outcome.status, 2) << flag;
    EXPECT_EQ(test::lines(outcome.err).size(), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(flag));
  }
}

}  // namespace
}  // namespace quincunx

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/growth_report.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using testing::ElementsAre;

TEST(Growth, IsTheFactorForADoubledEdge) {
  GrowthReport report;
  report.sizes = {16, 32, 128};
  report.lines.push_back({"gyroid", "grid", {10.0, 15.0, 60.0}, {8, 8, 8}});
  EXPECT_DOUBLE_EQ(growth_per_doubling(report, report.lines[0], 0), 1.5);
  EXPECT_DOUBLE_EQ(growth_per_doubling(report, report.lines[0], 1), 2.0);  // twice doubled, four times as long
  const Table table = growth_table(report);
  EXPECT_THAT(table.headings, ElementsAre("field", "structure", "16", "32", "128", "16 to 32", "32 to 128"));
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_THAT(table.rows[0], ElementsAre("gyroid", "grid", "10", "15", "60", "1.50", "2.00"));
}

TEST(GrowthProgram, MeasuresEveryStructureWithTheBetterBlockAtEverySize) {
  const test::TemporaryFolder folder;
  const test::Outcome outcome = test::run({"growth", "--fields", "sphere", "--sizes", "8,16", "--structures", "grid,distance", "--size", "32", "32",
                                           "--repeat", "1", "--markdown", "--json", folder / "growth.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto report = nlohmann::json::parse(test::read_file(folder / "growth.json"));
  ASSERT_EQ(report["lines"].size(), 3u);
  EXPECT_EQ(report["lines"][0]["structure"], "none");
  EXPECT_EQ(report["lines"][0]["block"], nlohmann::json({0, 0}));
  for (const auto& line : report["lines"]) {
    ASSERT_EQ(line["frame_ms"].size(), 2u);
    EXPECT_GT(line["frame_ms"][0], 0.0);
    ASSERT_EQ(line["per_doubling"].size(), 1u);
    EXPECT_DOUBLE_EQ(line["per_doubling"][0], line["frame_ms"][1].get<double>() / line["frame_ms"][0].get<double>());
    for (const auto& block : line["block"]) EXPECT_THAT(block.get<int>(), testing::AnyOf(0, 8, 16));
  }
  // Heading, rule, three lines, an empty one, the caption.
  EXPECT_EQ(test::lines(outcome.out).size(), 7u);
}

TEST(GrowthProgram, RefusesBadInputInOneLine) {
  test::expect_refused({"growth", "--fields", "cube"}, {"'cube'"});
  test::expect_refused({"growth", "--sizes", "64,32"}, {"--sizes"});
  test::expect_refused({"growth", "--block", "3"}, {"--block"});
  test::expect_refused({"growth", "--device", "cpu"}, {"the reference walks no structure"});
}

}  // namespace
}  // namespace quincunx

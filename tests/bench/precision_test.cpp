#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/precision_report.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

TEST(PrecisionReport, TakesTheMedianOfTheRatiosOfFramesOfOneTurn) {
  PrecisionReport report;
  report.lines.resize(2);
  report.lines[1].precision = Precision::float64;
  report.lines[0].cost.frame_ms = {10.0, 20.0, 40.0};
  report.lines[1].cost.frame_ms = {15.0, 60.0, 80.0};
  EXPECT_DOUBLE_EQ(times_float(report).median, 2.0);
  EXPECT_EQ(precision_table(report).rows[1][4], "2.00");
}

TEST(PrecisionProgram, TellsTimesErrorsAndBytesOfBoth) {
  const test::TemporaryFolder folder;
  const test::Outcome outcome = test::run({"precision", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--size", "64", "64", "--views", "2", "--repeat", "1",
                                           "--markdown", "--json", folder / "precision.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto report = nlohmann::json::parse(test::read_file(folder / "precision.json"));
  ASSERT_EQ(report["precisions"].size(), 2u);
  const auto &floats = report["precisions"][0], &doubles = report["precisions"][1];
  EXPECT_EQ(floats["precision"], "float");
  EXPECT_EQ(doubles["precision"], "double");
  EXPECT_EQ(doubles["coefficient_bytes"], 2 * floats["coefficient_bytes"].get<std::uint64_t>());
  EXPECT_GT(report["times_float"]["median"], 0.0);
  EXPECT_EQ(doubles["hits"], report["reference_hits"]);
  EXPECT_GT(doubles["hits"], 500);
  for (const char* key : {"missed", "false", "wrong_sheet", "depth_rms_cells"}) EXPECT_EQ(doubles["error"][key], 0.0) << key;
  EXPECT_LE(doubles["error"]["depth_rms_cells"], floats["error"]["depth_rms_cells"]);
  // Heading, rule, two lines, an empty one, the caption.
  EXPECT_EQ(test::lines(outcome.out).size(), 6u);
}

TEST(PrecisionProgram, RefusesTheReference) { test::expect_refused({"precision", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--device", "cpu"}, {"--device"}); }

}  // namespace
}  // namespace quincunx

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/steps_report.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

TEST(SphereLook, HasTheAlphaThatAFineSumHas) {
  const DirectVolume look = SphereLook::volume(Classify::post, 1.0);
  constexpr int kParts = 200000;
  for (const double distance : {0.0, 0.3, 0.6, 0.79}) {
    const double reach = std::sqrt(0.64 - distance * distance), length = 2.0 * reach / kParts;
    double depth = 0.0;
    for (int n = 0; n < kParts; ++n) {
      const double s = -reach + (n + 0.5) * length;
      depth -= std::log(1.0 - look.function.opacity(0.64 - distance * distance - s * s)) * length / look.function.unit;
    }
    EXPECT_NEAR(SphereLook::alpha(distance), 1.0 - std::exp(-depth), 1e-9) << distance;
  }
  EXPECT_EQ(SphereLook::alpha(0.8), 0.0);
  EXPECT_EQ(SphereLook::alpha(1.0), 0.0);
}

TEST(StepsMeasure, FindsOrderTwoInDoublePrecision) {
  std::string device;
  const StepsPlan plan{.splines = {"bcc7", "tricubic"}, .cells = 40, .steps = {0.8, 0.4, 0.2}, .size = 24, .rounds = 1, .device = "cpu"};
  const std::vector<StepLine> lines = measure_steps(plan, device);
  ASSERT_EQ(lines.size(), 6u);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    EXPECT_EQ(lines[n].spline, plan.splines[n / 3]);
    EXPECT_EQ(lines[n].post.frame_ms.size(), 1u);
    EXPECT_GT(lines[n].pre_integrated.rms, lines[n].post.rms);  // chords lie below a curve, midpoints on it
    EXPECT_LE(lines[n].post.rms, lines[n].post.largest);
    if (n % 3 == 0) continue;
    EXPECT_NEAR(order_between(lines[n - 1], lines[n], &StepLine::post), 2.0, 0.3) << n;
    EXPECT_NEAR(order_between(lines[n - 1], lines[n], &StepLine::pre_integrated), 2.0, 0.35) << n;
  }
  EXPECT_LT(lines[2].post.rms, 2e-4);
}

StepsReport known_steps_report() {
  StepsReport report{.plan = {}, .machine = {"a device", "", "a processor", 2}, .lines = {}};
  report.lines = {{"bcc7", 0.8, {0.04, 0.1, {3.0, 1.0, 2.0}}, {0.01, 0.02, {4.0}}}, {"bcc7", 0.4, {0.01, 0.025, {5.0}}, {0.00125, 0.002, {6.0}}},
                  {"trilinear", 0.8, {0.5, 0.5, {7.0}}, {0.5, 0.5, {8.0}}}};
  return report;
}

TEST(StepsReport, ShowsErrorsAndTheOrderBetweenTheStepsOfASpline) {
  const Table table = steps_table(known_steps_report());
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_THAT(table.rows[0], ElementsAre("bcc7", "0.8", "4.0e-02", "-", "1.0e-01", "2", "1.0e-02", "-", "2.0e-02", "4"));
  EXPECT_THAT(table.rows[1], ElementsAre("bcc7", "0.4", "1.0e-02", "2.00", "2.5e-02", "5", "1.3e-03", "3.00", "2.0e-03", "6"));
  EXPECT_THAT(table.rows[2], ElementsAre("trilinear", "0.8", "5.0e-01", "-", "5.0e-01", "7", "5.0e-01", "-", "5.0e-01", "8"));
  EXPECT_EQ(table.headings.size(), table.rows[0].size());
  const auto json = steps_json(known_steps_report());
  EXPECT_TRUE(json["lines"][0]["post"]["order"].is_null());
  EXPECT_DOUBLE_EQ(json["lines"][1]["post"]["order"], 2.0);
  EXPECT_THAT(steps_caption(known_steps_report()), HasSubstr("a device"));
}

TEST(Steps, PrintsATableAndWritesTheSameAsJson) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "steps.json";
  const test::Outcome outcome = test::run({"steps", "--splines", "trilinear", "--steps", "2,1", "--cells", "16", "--size", "16", "--repeat", "1", "--quiet", "--json", file});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("trilinear"));
  EXPECT_EQ(Json::parse(test::read_file(file))["lines"].size(), 2u);
  test::expect_refused({"steps", "--steps", "1,2"}, {"--steps", "descending"});
  test::expect_refused({"steps", "--steps", "0"}, {"--steps", "0.001"});
  test::expect_refused({"steps", "--splines", "none"}, {"--splines", "bcc7"});
}

}  // namespace
}  // namespace quincunx

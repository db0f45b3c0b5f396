#include "bench/convergence_measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace quincunx {
namespace {

TEST(ConvergenceMeasure, FindsTheOrdersThatTheoryHas) {
  ConvergencePlan plan;
  plan.splines = {"trilinear", "bcc7"};
  plan.samples = {31, 46, 69};
  plan.points = 2000;
  const std::vector<ConvergenceLine> lines = measure_convergence(plan);
  ASSERT_EQ(lines.size(), 3u);  // bcc7 with its prefilter and without
  for (const ConvergenceLine& line : lines) {
    EXPECT_NEAR(line.order(&VolumeErrors::value_rmse, 2), line.filter.order, 0.3) << line.spline << " " << prefilter_name(line.filter.kind);
    // Where the next order still has a large part, they fall faster.
    EXPECT_GT(line.order(&VolumeErrors::gradient_rmse, 2), line.gradient_order() - 0.3) << line.spline << " " << prefilter_name(line.filter.kind);
    EXPECT_LT(line.order(&VolumeErrors::gradient_rmse, 2), line.gradient_order() + 1.2) << line.spline << " " << prefilter_name(line.filter.kind);
  }
  EXPECT_EQ(lines[0].gradient_order(), 1);
  EXPECT_EQ(lines[1].gradient_order(), 3);
  EXPECT_EQ(lines[2].gradient_order(), 2);
  EXPECT_EQ(convergence_table(plan, lines).rows.size(), 3u);
  EXPECT_EQ(convergence_json(plan, lines)["splines"][2]["value_rmse"].size(), 3u);
}

TEST(ConvergenceProgram, RefusesSpacingsThatTellNoOrder) {
  test::expect_refused({"convergence", "--samples", "30"}, {"--samples", "30", "two or more"});
  test::expect_refused({"convergence", "--samples", "40,30"}, {"--samples: found 30 after 40"});
  test::expect_refused({"convergence", "--splines", "bcc9"}, {"bcc9", "bcc7"});
}

}  // namespace
}  // namespace quincunx

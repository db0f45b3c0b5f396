// quincunx stability: the command, its catalogue, and what its measurements catch.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "bench/stability_report.h"
#include "lattice/error.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

TEST(StabilityCatalogue, SamplesEveryCaseOnBothLatticesWithFiniteNumbers) {
  std::set<std::string> names;
  for (const std::string_view group : stability_groups())
    for (const StabilityCase& c : stability_cases(group)) {
      EXPECT_EQ(c.group, group);
      EXPECT_TRUE(names.insert(c.group + ": " + c.name).second) << c.name << " stands twice";
      for (const LatticeKind lattice : {LatticeKind::bcc, LatticeKind::cartesian}) {
        const Volume volume = c.sampled(lattice);
        check_volume(volume, c.name);
        EXPECT_EQ(sample_range(volume).not_finite > 0, group == "data") << c.name;
        EXPECT_GE(c.views(lattice).size(), 1u) << c.name;
      }
    }
  EXPECT_GT(names.size(), 60u);
  EXPECT_THROW(stability_cases("dull"), InputError);
}

TEST(StabilityMeasure, PassesACaseAndCountsWhatAMarchLoses) {
  std::vector<StabilityCase> cases = stability_cases("stiff");
  std::erase_if(cases, [](const StabilityCase& c) { return c.name != "noise"; });
  ASSERT_EQ(cases.size(), 1u);
  StabilityPlan plan{.cases = cases, .splines = {"bcc7", "trilinear"}, .device = "", .step = 0.9, .huge = false, .points = 500, .seed = 1};
  std::vector<StabilityLine> lines;
  std::string device;
  measure_stability(plan, lines, device);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_FALSE(device.empty());
  for (const StabilityLine& line : lines) {
    EXPECT_TRUE(line.passed()) << line.spline;
    EXPECT_GT(line.evaluation.value, 0.1);  // floats are not exact
    EXPECT_GT(line.exact.expected, 1000u);
    EXPECT_GT(line.march.holes + line.march.wrong, 20u) << "a march of 0.9 cells through noise loses hits";
  }
}

TEST(KnownRoots, AreFoundInEveryDegree) {
  std::string device;
  const std::vector<RootsLine> lines = measure_roots({.degrees = {3, 4, 9}, .device = "", .count = 20000, .seed = 5}, device);
  ASSERT_EQ(lines.size(), 9u);
  for (const RootsLine& line : lines) {
    EXPECT_TRUE(line.passed()) << line.degree << " " << line.kind;
    EXPECT_EQ(line.count, 20000u);
    EXPECT_GT(line.residual, 0.0);
    EXPECT_LT(line.off, 1e-6);
  }
}

TEST(Watertight, NoRayLeaksThroughAClosedSurface) {
  std::string device;
  const std::vector<WatertightLine> lines = measure_watertight({.splines = {"bcc7"}, .device = "", .rays = 20000, .seed = 9, .size = 128}, device);
  ASSERT_EQ(lines.size(), 3u);
  for (const WatertightLine& line : lines) {
    EXPECT_TRUE(line.passed()) << line.surface;
    EXPECT_GE(line.rays, 20000u);
    EXPECT_LT(line.off, 0.01) << line.surface;
  }
}

StabilityReport small_report() {
  StabilityReport report{.command = "quincunx stability --groups \"<&>\"", .machine = {"a device", "a driver", "a processor", 2}, .step = 0.25, .seed = 1, .lines = {}, .roots = {}, .watertight = {}};
  report.lines.push_back({"flat", "a plateau, level", "bcc7", 0.25, {1.0, 2.0, 512.0, 2048.0}, {}, {}, {}, {}});
  report.lines.push_back(report.lines.front());
  report.lines.back().exact.holes = 3;
  RootsLine roots;
  roots.degree = 4;
  roots.kind = "pairs";
  report.roots.push_back(roots);
  return report;
}

TEST(StabilityReport, TellsPassedFromFailed) {
  const StabilityReport report = small_report();
  EXPECT_EQ(stability_score(report).passed, 2u);
  EXPECT_EQ(stability_score(report).all, 3u);
  const Json json = Json::parse(stability_json(report).dump());
  EXPECT_EQ(json["cases"][0]["passed"], true);
  EXPECT_EQ(json["cases"][1]["passed"], false);
  EXPECT_EQ(json["cases"][1]["exact"]["holes"], 3);
  EXPECT_THAT(plain_text(stability_sections(report)[0].table), HasSubstr("FAIL"));
  EXPECT_EQ(stability_sections(report).size(), 2u);
}

TEST(StabilityReport, QuotesWhatCsvAndHtmlWouldMisread) {
  const StabilityReport report = small_report();
  const std::string csv = stability_csv(report), html = stability_html(report);
  EXPECT_THAT(csv, HasSubstr("flat,\"a plateau, level\",bcc7,0.25,"));
  std::istringstream lines(csv);
  std::string heading;
  std::getline(lines, heading);
  EXPECT_EQ(std::count(heading.begin(), heading.end(), ','), 26);
  EXPECT_THAT(html, HasSubstr("--groups &quot;&lt;&amp;&gt;&quot;"));
  EXPECT_THAT(html, HasSubstr("2 of 3 passed"));
  EXPECT_THAT(html, HasSubstr("class=\"fail\""));
  for (const char* outside : {"http://", "https://", "<script", "<link", "src="}) EXPECT_THAT(html, Not(HasSubstr(outside)));
}

TEST(StabilityCommand, WritesItsReports) {
  const test::TemporaryFolder folder;
  const std::string out = folder / "report";
  const test::Outcome run = test::run({"stability", "--groups", "flat", "--splines", "bcc7", "--points", "100", "--quiet", "-o", out});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("constant, at the isovalue"));
  EXPECT_THAT(run.out, HasSubstr("10 of 10 passed"));
  EXPECT_THAT(test::read_file(out + "/stability.csv"), HasSubstr("flat,\"constant, at the isovalue\",bcc7,"));
  EXPECT_THAT(test::read_file(out + "/stability.html"), HasSubstr("10 of 10 passed"));
  const Json json = Json::parse(test::read_file(out + "/stability.json"));
  EXPECT_EQ(json["passed"], 10);
  EXPECT_THAT(json["command"].get<std::string>(), HasSubstr("--groups flat"));
}

TEST(StabilityCommand, NamesWhatItDoesNotKnow) {
  test::expect_refused({"stability", "--groups", "dull"}, {"--groups", "dull", "stiff"});
  test::expect_refused({"stability", "--groups", "flat,flat"}, {"--groups: found flat twice"});
  test::expect_refused({"stability", "--splines", "bcc9"}, {"--splines", "bcc9", "bcc7"});
  test::expect_refused({"stability", "--splines", "cwlb"}, {"--splines", "cwlb", "no polynomials", "bcc7"});
  test::expect_refused({"stability", "--rays", "0"}, {"--rays"});
  test::expect_refused({"stability", "--device", "cpu"}, {"cpu"});
}

}  // namespace
}  // namespace quincunx

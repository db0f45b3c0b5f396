// quincunx-bench intersect as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/volume_file.h"
#include "lattice/field.h"
#include "tests/app/program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class IntersectBench : public ProgramInFolder {
 protected:
  IntersectBench() {
    write_volume(sample_field(*make_field("marschner-lobb"), LatticeKind::bcc, {10, 10, 10}), volume);
  }

  Arguments intersect(const Arguments& more, const std::string& steps = "0.5,0.125") const {
    Arguments arguments{"intersect", volume, "--iso", "0.5", "--size", "64", "64", "--repeat", "1", "--steps", steps};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const std::string volume = folder / "ml.nrrd";
};

/// The setting's entry.
json entry(const json& report, const std::string& intersect, double step, const std::string& structure) {
  for (const json& setting : report["settings"]) {
    if (setting["intersect"] == intersect && setting.value("step", 0.0) == step && setting["structure"] == structure)
      return setting;
  }
  ADD_FAILURE() << intersect << " " << step << " " << structure << " is not there";
  return {};
}

TEST_F(IntersectBench, ReportsEverySettingAndThatExactLosesNothingWhereMarchingDoes) {
  const std::string path = folder / "report.json";
  const Outcome outcome = run(intersect({"--views", "2", "--json", path}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(read_file(path));

  // exact and 0.5 and 0.125, each with grid and none, and the published method.
  ASSERT_EQ(report["settings"].size(), 7u);
  EXPECT_EQ(report["rays"], 2 * 64 * 64);
  const std::uint64_t hits = report["reference_hits"];
  EXPECT_GT(hits, 500u);
  for (const json& setting : report["settings"]) {
    EXPECT_GT(setting["trace_ms"]["median"], 0.0);
    EXPECT_GE(setting["trace_ms"]["p95"], setting["trace_ms"]["p5"]);
    EXPECT_GT(setting["evaluations_per_ray"], 0.0);
    const json& error = setting["error"];
    EXPECT_EQ(setting["hits"].get<std::uint64_t>(),
              hits - error["missed"].get<std::uint64_t>() + error["false"].get<std::uint64_t>());
    EXPECT_LT(error["depth_rms_cells"], 1e-4);
  }
  const json exact = entry(report, "exact", 0.0, "grid"), coarse = entry(report, "march", 0.5, "none");
  EXPECT_EQ(exact["error"]["missed"], 0);
  EXPECT_EQ(exact["error"]["wrong_sheet"], 0);
  EXPECT_GT(coarse["error"]["missed"].get<int>() + coarse["error"]["wrong_sheet"].get<int>(), 0);
  EXPECT_GT(coarse["error"]["depth_rms_cells"], exact["error"]["depth_rms_cells"]);
  EXPECT_EQ(entry(report, "march", 0.25, "none")["speedup"]["median"], 1.0);
  // Skipping changes no hit and saves evaluations; smaller steps take more of them.
  EXPECT_EQ(exact["error"], entry(report, "exact", 0.0, "none")["error"]);
  EXPECT_EQ(coarse["error"], entry(report, "march", 0.5, "grid")["error"]);
  EXPECT_LT(exact["evaluations_per_ray"], entry(report, "exact", 0.0, "none")["evaluations_per_ray"]);
  EXPECT_GT(entry(report, "march", 0.125, "none")["evaluations_per_ray"], coarse["evaluations_per_ray"]);
}

TEST_F(IntersectBench, WritesJsonAndMarkdownToAFolderAndPrintsTheSameTable) {
  const Outcome outcome = run(intersect({"--views", "1", "--no-error", "--markdown", "-o", folder / "."}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, read_file(folder / "intersect.md"));
  const json report = json::parse(read_file(folder / "intersect.json"));
  EXPECT_FALSE(report.contains("reference_hits"));
  EXPECT_FALSE(report["settings"][0].contains("error"));
  // Heading, rule, 7 settings, an empty line and the caption.
  const std::vector<std::string> text = lines(outcome.out);
  ASSERT_EQ(text.size(), 11u);
  EXPECT_THAT(text[0], testing::AllOf(HasSubstr(" ms |"), testing::Not(HasSubstr("missed"))));
  EXPECT_THAT(text[2], testing::StartsWith("| exact"));
  EXPECT_THAT(text[10], testing::AllOf(HasSubstr("ml.nrrd, isovalue 0.5, 64 x 64, 1 view,"), HasSubstr("cores of")));
}

TEST_F(IntersectBench, RefusesBadInputInOneLine) {
  expect_refused({}, {"subcommand"});
  expect_refused({"intersect", volume}, {"--iso"});
  expect_refused(intersect({"--bogus"}), {"'--bogus'", "quincunx-bench intersect --help"});
  expect_refused(intersect({}, "0.5,x"), {"--steps", "'x'"});
  expect_refused(intersect({}, "0"), {"--steps", "found 0", "0.001"});
  expect_refused(intersect({}, "0.5,0.50"), {"--steps", "twice"});
  expect_refused(intersect({"--block", "12"}), {"--block", "power of two"});
  expect_refused(intersect({"--views", "0"}), {"--views", "'0'"});
  expect_refused(intersect({"--device", "no such device"}), {"no such device"});
  expect_refused(intersect({"--json", folder / "no/such/f.json"}), {"no/such"});
  expect_refused(intersect({"-o", folder / "nowhere"}), {"nowhere"});
  expect_refused({"intersect", folder / "none.nrrd", "--iso", "1"}, {"none.nrrd"});
}

}  // namespace
}  // namespace quincunx::test

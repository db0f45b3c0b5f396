#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace quincunx {
namespace {

TEST(VoxelsProgram, TellsMemoryErrorAndTimeOfVoxelsBesideSplines) {
  const test::TemporaryFolder folder;
  const test::Outcome outcome = test::run({"voxels", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--tf", QUINCUNX_SOURCE_DIR "/data/transfer/neghip_clear.json", "--size", "48", "48", "--views", "2",
                                           "--repeat", "1", "--supersample", "1,2", "--lod", "8", "--markdown", "--json", folder / "voxels.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto lines = nlohmann::json::parse(test::read_file(folder / "voxels.json"))["lines"];
  ASSERT_EQ(lines.size(), 7u);  // three of splines, two factors with and without merging
  const auto &truth = lines[0], &usual = lines[2], &plain = lines[3], &merged = lines[4], &finer = lines[5];
  EXPECT_EQ(truth["rms_levels"], 0.0);
  EXPECT_GT(usual["rms_levels"], 0.0);
  EXPECT_LT(finer["rms_levels"], plain["rms_levels"]) << "smaller voxels are nearer";
  EXPECT_GT(finer["rms_levels"], 0.0);
  EXPECT_LT(merged["voxels"], plain["voxels"]);
  EXPECT_GT(finer["voxels"], 4 * plain["voxels"].get<int>());
  for (const auto& line : lines) {
    EXPECT_EQ(line["frames_ms"].size(), 2u);
    EXPECT_EQ(line["grid_bytes"], truth["grid_bytes"]);
    if (line["way"] != "voxels") continue;
    EXPECT_GE(line["bytes"], 8 * line["nodes"].get<std::uint64_t>() + 16 * line["voxels"].get<std::uint64_t>());
  }
  // Heading, rule, seven lines, an empty one, the caption.
  EXPECT_EQ(test::lines(outcome.out).size(), 11u);
}

TEST(VoxelsProgram, RefusesWhatItCannotSee) {
  const test::Outcome none = test::run({"voxels", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd"});
  EXPECT_EQ(none.status, 2);
  const test::Outcome small = test::run({"voxels", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--tf", QUINCUNX_SOURCE_DIR "/data/transfer/neghip_clear.json", "--supersample", "0.5"});
  EXPECT_EQ(small.status, 2);
  EXPECT_NE(small.err.find("--supersample"), std::string::npos) << small.err;
}

}  // namespace
}  // namespace quincunx

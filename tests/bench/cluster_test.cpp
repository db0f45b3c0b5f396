#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "accel/cluster.h"
#include "bench/cluster_masks.h"
#include "bench/cluster_report.h"
#include "lattice/error.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

TEST(ClusterMasks, AreTheSameEveryTimeAndOfTheirCharacter) {
  // Active parts: what the generators stop at, the sheets of three periods, one in ten; the vessels' is not known beforehand.
  const std::vector<std::pair<double, double>> parts{{0.083, 0.1}, {0.142, 0.19}, {0.005, 0.2}, {0.4, 0.6}, {0.095, 0.105}};
  ASSERT_EQ(mask_names().size(), parts.size());
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Classification mask = generated_mask(mask_names()[n], 40), again = generated_mask(mask_names()[n], 40);
    EXPECT_EQ(mask.blocks, glm::i64vec3(40));
    ASSERT_EQ(mask.level.size(), 64000u);
    EXPECT_EQ(mask.level, again.level) << mask_names()[n];
    EXPECT_EQ(mask.active_blocks, std::size_t(std::count(mask.level.begin(), mask.level.end(), Classification::active)));
    const double part = double(mask.active_blocks) / 64000.0;
    EXPECT_GE(part, parts[n].first) << mask_names()[n];
    EXPECT_LE(part, parts[n].second) << mask_names()[n];
  }
  EXPECT_THROW(generated_mask("cheese", 4), InputError);
}

TEST(ClusterMasks, OfAGyroidHoldEveryBlockThatItsSheetsCross) {
  const int n = 36;
  const Classification mask = generated_mask("gyroid", n);
  const double k = 3.0 * 2.0 * 3.14159265358979 / n;
  std::size_t crossed = 0;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        int above = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const double u = k * (x + (corner & 1)), v = k * (y + (corner >> 1 & 1)), w = k * (z + (corner >> 2));
          above += std::sin(u) * std::cos(v) + std::sin(v) * std::cos(w) + std::sin(w) * std::cos(u) > 0.0;
        }
        if (above == 0 || above == 8) continue;
        ++crossed;
        EXPECT_EQ(mask.level[std::size_t((z * n + y) * n + x)], Classification::active) << x << " " << y << " " << z;
      }
  EXPECT_GT(crossed, 0u);
  EXPECT_LT(mask.active_blocks, 3 * crossed);
}

TEST(ClusterMeasure, CountsTheLeavesThatTheClusterersMake) {
  for (const std::string_view name : mask_names()) {
    const Classification mask = generated_mask(name, 24);
    const ClusterLine line = measure_clusters(std::string(name), mask, 3, 2);
    EXPECT_EQ(line.active, mask.active_blocks);
    EXPECT_EQ(line.single.leaves, mask.active_blocks);
    EXPECT_EQ(line.cubes.leaves, cluster_cubes(mask, 3).size()) << name;
    EXPECT_EQ(line.boxes.leaves, cluster_boxes(mask).size()) << name;
    for (const ClusterCost* cost : {&line.single, &line.cubes, &line.boxes}) {
      EXPECT_EQ(cost->cluster_ms.size(), 2u);
      EXPECT_EQ(cost->build_ms.size(), 2u);
    }
    EXPECT_GT(*std::min_element(line.cubes.cluster_ms.begin(), line.cubes.cluster_ms.end()), 0.0);
  }
}

TEST(ClusterReport, ShowsMediansPartsAndTheMedianOfRatios) {
  ClusterReport report{.max_cluster = 8, .rounds = 3, .machine = {"", "", "a processor", 3}, .lines = {}};
  report.lines.push_back({.mask = "strands", .blocks = {10, 20, 5}, .active = 200, .single = {200, {0, 0, 0}, {9, 8, 7}},
                          .cubes = {80, {40, 60, 90}, {6, 4, 5}}, .boxes = {50, {10, 12, 30}, {3, 2, 1}}});
  report.lines.push_back({.mask = "none", .blocks = {2, 2, 2}, .active = 0, .single = {0, {0}, {1}}, .cubes = {0, {1}, {1}}, .boxes = {0, {1}, {1}}});
  const Table table = cluster_table(report);
  ASSERT_EQ(table.rows.size(), 2u);
  // The ratios are 4, 5 and 3: their median is not the ratio of the medians.
  EXPECT_THAT(table.rows[0], ElementsAre("strands", "1000", "200", "20.0", "80", "40.0", "50", "25.0", "60", "12", "4", "8", "5", "2"));
  EXPECT_EQ(table.rows[1][5], "0.0");
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.headings.size());
  EXPECT_THAT(cluster_caption(report), HasSubstr("on 3 cores of a processor"));
  EXPECT_THAT(cluster_caption(report), HasSubstr("17.6 ms for 22,058 active of 262,144 blocks"));
}

TEST(ClusterProgram, MeasuresVolumesAtEveryBlockSizeAndThenGeneratedMasks) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(test::run({"cluster", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--blocks", "2,4", "--generated",
                       "--sizes", "12", "--repeat", "2", "--max-cluster", "4", "--json", folder / "cluster.json"})
                .status,
            0);
  const Json report = Json::parse(test::read_file(folder / "cluster.json"));
  EXPECT_EQ(report["max_cluster"], 4);
  ASSERT_EQ(report["masks"].size(), 2u + mask_names().size());
  EXPECT_EQ(report["masks"][0]["mask"], "neghip_bcc at 40, blocks of 2");
  EXPECT_EQ(report["masks"][1]["mask"], "neghip_bcc at 40, blocks of 4");
  EXPECT_EQ(report["masks"][2]["mask"], "strands, 12^3");
  for (const Json& mask : report["masks"]) {
    EXPECT_EQ(mask["single"]["leaves"], mask["active"]);
    EXPECT_LE(mask["cubes"]["leaves"], mask["active"]);
    EXPECT_LE(mask["boxes"]["leaves"], mask["active"]);
    EXPECT_GT(mask["boxes"]["leaves"], 0);
    EXPECT_GT(mask["speedup"]["median"], 0.0);
  }
}

TEST(ClusterProgram, PrintsMarkdownWithItsCaptionLast) {
  const test::Outcome outcome = test::run({"cluster", "--sizes", "8", "--repeat", "1", "--markdown"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<std::string> lines = test::lines(outcome.out);
  // Heading, rule, five masks, an empty line, the caption.
  ASSERT_EQ(lines.size(), 9u);
  EXPECT_THAT(lines[2], HasSubstr("| strands, 8^3"));
  EXPECT_THAT(lines[8], HasSubstr("on other hardware"));
}

TEST(ClusterProgram, RefusesBadInputInOneLine) {
  test::expect_refused({"cluster", "a.nrrd"}, {"found 0 isovalues for 1 volume,"});
  test::expect_refused({"cluster", "a.nrrd", "--iso", "1,2"}, {"found 2 isovalues for 1 volume,"});
  test::expect_refused({"cluster", "--iso", "1"}, {"found no volume"});
  test::expect_refused({"cluster", "--sizes", "0"}, {"--sizes"});
  test::expect_refused({"cluster", "--max-cluster", "300"}, {"--max-cluster"});
  test::expect_refused({"cluster", "--blocks", "3"}, {"--blocks"});
}

}  // namespace
}  // namespace quincunx

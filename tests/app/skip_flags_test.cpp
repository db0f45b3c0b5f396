#include "app/skip_flags.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "accel/structure.h"
#include "io/image_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string neghip = QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd";

/// What these arguments say, checked.
SkipConfig config_of(Arguments arguments) {
  CLI::App app;
  SkipFlags flags;
  add_skip_flags(app, flags, "Method");
  std::reverse(arguments.begin(), arguments.end());  // the parser takes them from the back
  app.parse(arguments);
  check_skip_flags(flags);
  return flags.config;
}

/// The flags that stand for a label: "bvh:cubes" is --skip bvh --cluster cubes.
Arguments flags_of(std::string_view label) {
  const std::size_t colon = label.find(':');
  const std::string structure(label.substr(0, colon));
  Arguments flags{"--skip", structure};
  if (colon != label.npos) flags.insert(flags.end(), {structure == "bvh" ? "--cluster" : structure == "hybrid" ? "--hybrid" : "--kd", std::string(label.substr(colon + 1))});
  return flags;
}

TEST(SkipFlags, LeaveStructureAndBlocksToTheSceneWhereNoneIsGiven) { EXPECT_EQ(config_of({}), SkipConfig{}); }

TEST(SkipFlags, MeanTheConfigurationOfTheirLabel) {
  for (const std::string_view label : skip_labels()) EXPECT_EQ(config_of(flags_of(label)), labelled_skip(label)) << label;
}

TEST(SkipFlags, NameHowRangesAreLookedFor) {
  EXPECT_EQ(config_of({"--range-query", "intervals"}), SkipConfig{});
  EXPECT_EQ(config_of({"--range-query", "table"}).range_query, RangeQueryKind::table);
  EXPECT_EQ(config_of({"--skip", "grid", "--range-query", "irt"}).range_query, RangeQueryKind::irt);
}

TEST(SkipFlags, TakeCubesWhereNoClusteringIsNamed) {
  EXPECT_EQ(config_of({"--skip", "bvh", "--cluster"}).clustering, Clustering::cubes);
  EXPECT_EQ(config_of({"--cluster", "--skip", "bvh"}).clustering, Clustering::cubes);
  EXPECT_EQ(config_of({"--skip", "bvh", "--cluster", "none"}).clustering, Clustering::none);
  EXPECT_EQ(config_of({"--skip", "bvh", "--cluster", "boxes"}).clustering, Clustering::boxes);
  EXPECT_EQ(config_of({"--skip", "bvh"}).clustering, Clustering::none);
  const SkipConfig small = config_of({"--skip", "bvh", "--cluster", "--max-cluster", "4"});
  EXPECT_EQ(small.clustering, Clustering::cubes);
  EXPECT_EQ(small.max_cluster, 4);
}

TEST(SkipFlags, OfAnotherStructureAreRefusedInOneLine) {
  // The flag that is named, what it says was found, what it says is expected.
  const std::vector<std::pair<Arguments, std::vector<std::string>>> cases{
      {{"--cluster"}, {"--cluster", "--skip auto", "--skip bvh"}},
      {{"--skip", "grid", "--cluster", "boxes"}, {"--cluster", "--skip grid", "--skip bvh"}},
      {{"--skip", "kdtree", "--cluster", "none"}, {"--cluster", "--skip kdtree", "--skip bvh"}},
      {{"--kd", "deep"}, {"--kd", "--skip auto", "--skip kdtree"}},
      {{"--skip", "bvh", "--kd", "shallow"}, {"--kd", "--skip bvh", "--skip kdtree"}},
      {{"--skip", "grid", "--hybrid", "mm"}, {"--hybrid", "--skip grid", "--skip hybrid"}},
      {{"--skip", "hybrid", "--hybrid", "min"}, {"--hybrid", "'min'", "mm, pc"}},
      {{"--skip", "hybrid", "--kd", "shallow"}, {"--kd", "--skip hybrid", "--skip kdtree"}},
      {{"--skip", "kdtree", "--least-leaf", "0.2"}, {"--least-leaf", "--skip kdtree", "--skip kdtree --kd shallow"}},
      {{"--skip", "hybrid", "--least-leaf", "0"}, {"--least-leaf", "'0'", "above 0"}},
      {{"--max-cluster", "4"}, {"--max-cluster", "--cluster none", "--cluster cubes"}},
      {{"--skip", "bvh", "--cluster", "boxes", "--max-cluster", "4"}, {"--max-cluster", "--cluster boxes", "--cluster cubes"}},
      {{"--skip", "bvh", "--cluster", "spheres"}, {"--cluster", "'spheres'", "none, cubes, boxes"}},
      {{"--skip", "bvh", "--cluster", "cubes", "--max-cluster", "0"}, {"--max-cluster", "0", "from 1 to 256"}},
      {{"--range-query", "tree"}, {"--range-query", "'tree'", "intervals, table, irt"}},
      {{"--skip", "kdtree", "--kd", "half"}, {"--kd", "'half'", "shallow, deep"}},
      {{"--skip", "grid", "--max-segments", "4"}, {"--max-segments", "--skip grid", "--skip segments"}},
      {{"--skip", "segments", "--max-segments", "65"}, {"--max-segments", "65", "from 1 to 64"}},
      {{"--block", "12"}, {"--block", "12", "power of two"}}};
  for (const auto& [flags, parts] : cases) {
    SCOPED_TRACE(testing::PrintToString(flags));
    Arguments arguments{"render", neghip, "--iso", "40", "--json"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("quincunx: " + parts[0]), HasSubstr(parts[1]), HasSubstr(parts[2])));
  }
}

/// Pictures of 48 x 48 rays through neghip at isovalue 40, beside what `--json` prints.
class EveryWayToSkip : public testing::Test {
 protected:
  struct Shown {
    Image image;
    json stats;
  };
  Shown render(const Arguments& flags) const {
    Arguments arguments{"render", neghip, "--iso", "40", "--size", "48", "48", "--json", "-o", folder / "picture.exr"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return {read_image(folder / "picture.exr"), json::parse(outcome.out)};
  }

  const TemporaryFolder folder;
};

/// The label of what the statistics say was used.
std::string label_of(const json& stats) {
  std::string label = stats["structure"];
  EXPECT_EQ(stats.contains("cluster"), label == "bvh");
  EXPECT_EQ(stats.contains("kd"), label == "kdtree");
  EXPECT_EQ(stats.contains("hybrid"), label == "hybrid");
  EXPECT_EQ(stats.contains("least_leaf"), label == "hybrid" || stats.value("kd", "") == "shallow");
  if (stats.value("cluster", "none") != "none") label += ":" + stats["cluster"].get<std::string>();
  if (stats.contains("hybrid")) label += ":" + stats["hybrid"].get<std::string>();
  if (stats.contains("kd")) label += ":" + stats["kd"].get<std::string>();
  return label;
}

TEST_F(EveryWayToSkip, MakesThePixelsOfNoneWithLessWorkAndSaysWhatItWas) {
  const Shown plain = render({"--skip", "none"});
  EXPECT_EQ(plain.stats["structure"], "none");
  EXPECT_FALSE(plain.stats.contains("block"));
  EXPECT_GT(plain.stats["hits"], 100);
  for (const std::string_view label : skip_labels()) {
    if (label == "none") continue;
    SCOPED_TRACE(label);
    Arguments flags = flags_of(label);
    flags.insert(flags.end(), {"--block", "4"});
    const Shown shown = render(flags);
    ASSERT_EQ(shown.image.channels, plain.image.channels);
    ASSERT_EQ(shown.image.pixels.size(), plain.image.pixels.size());
    EXPECT_EQ(std::memcmp(shown.image.pixels.data(), plain.image.pixels.data(), plain.image.pixels.size() * sizeof(float)), 0);
    EXPECT_LT(shown.stats["evaluations"], plain.stats["evaluations"]);

    EXPECT_EQ(label_of(shown.stats), label);
    EXPECT_EQ(shown.stats["block"], 4);
  }
}

TEST_F(EveryWayToSkip, LeftOpenSaysWhichItTookAndWhy) {
  const std::vector<Arguments> cases{{}, {"--skip", "auto"}, {"--skip", "auto", "--block", "8"}, {"--skip", "octree"}};
  for (const Arguments& flags : cases) {
    SCOPED_TRACE(testing::PrintToString(flags));
    Arguments arguments = flags;
    arguments.push_back("--explain");
    const json stats = render(arguments).stats;
    EXPECT_THAT(skip_labels(), testing::Contains(label_of(stats)));
    EXPECT_EQ(stats["structure"] == "octree", flags == cases[3]);
    if (flags == cases[2]) {
      EXPECT_EQ(stats["block"], 8);
    }

    const json& features = stats["explain"];
    const auto skipping = std::ranges::find(features, "skipping structure", [](const json& f) { return f["name"].get<std::string>(); });
    ASSERT_NE(skipping, features.end());
    const std::string why = (*skipping)["why"], which = fmt::format("{}, blocks of {} cells: ", label_of(stats), stats["block"].get<int>());
    EXPECT_THAT(why, StartsWith(which));
    EXPECT_GT(why.size(), which.size());
  }
}

}  // namespace
}  // namespace quincunx::test

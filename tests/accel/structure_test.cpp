#include "accel/structure.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "coefficient_sets.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// Blocks of a small volume.
struct Example {
  Example(int block, double isovalue)
      : blocks(block_bounds(cells, block)), classification(classify(blocks, cells, ranges_of(std::vector{isovalue}))), thresholds(cells, ranges_of(std::vector{isovalue})) {}

  CellBounds cells = bounds_of(smooth_coefficients({9, 7, 5}));
  BlockBounds blocks;
  Classification classification;
  Thresholds thresholds;
};

TEST(Structure, EveryNameMakesAStructureOfThatName) {
  for (std::string_view name : structure_names()) {
    SkipConfig config;
    config.structure = name;
    EXPECT_EQ(make_structure(config)->name(), name);
  }
}

TEST(Structure, EveryLabelIsThatOfItsOwnConfigurationAndEveryStructureHasOne) {
  std::set<std::string> structures;
  for (std::string_view label : skip_labels()) {
    const SkipConfig config = labelled_skip(label, {.block = 8, .cell_test = false});
    EXPECT_EQ(skip_label(config), label);
    EXPECT_EQ(config.block, 8);
    EXPECT_FALSE(config.cell_test);
    structures.insert(config.structure);
  }
  EXPECT_EQ(structures, std::set<std::string>(structure_names().begin(), structure_names().end()));
  EXPECT_THROW(labelled_skip("bvh:spheres"), InputError);
}

TEST(Structure, EveryOneBuildsAgainAndAgainAndTellsWhatHasChanged) {
  for (std::string_view label : skip_labels()) {
    SCOPED_TRACE(label);
    const auto structure = make_structure(labelled_skip(label));
    std::map<std::string, std::uint64_t> versions;
    for (int block : {8, 2, 4}) {
      const Example e(block, 1000.0);
      structure->prepare(e.blocks);
      structure->build(e.classification, e.thresholds);
      const auto buffers = structure->buffers();
      EXPECT_EQ(buffers.empty(), structure->needs() == SkippingStructure::Needs::nothing);
      for (const StructureBuffer& buffer : buffers) {
        EXPECT_FALSE(buffer.name.empty());
        EXPECT_FALSE(buffer.bytes.empty());
        EXPECT_NE(versions[buffer.name], buffer.version);
        versions[buffer.name] = buffer.version;
      }
    }
  }
}

TEST(Structure, GridHandsOutTheLevelsOfItsBlocksAndKeepsThem) {
  const auto grid = make_structure(labelled_skip("grid"));
  std::vector<std::uint8_t> expected;
  {
    const Example e(4, 1000.0);
    EXPECT_THAT(e.classification.level, testing::Contains(Classification::active));
    expected = e.classification.level;
    grid->build(e.classification, e.thresholds);
  }
  const auto buffers = grid->buffers();
  ASSERT_EQ(buffers.size(), 1u);
  EXPECT_EQ(buffers[0].name, "gridLevel");
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(buffers[0].bytes.data());
  EXPECT_EQ(std::vector<std::uint8_t>(bytes, bytes + buffers[0].bytes.size()), expected);
}

TEST(Structure, AnUnknownNameIsRefusedNamingTheChoices) {
  try {
    SkipConfig config;
    config.structure = "pyramid";
    make_structure(config);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("pyramid"));
    for (std::string_view name : structure_names()) EXPECT_THAT(e.what(), testing::HasSubstr(std::string(name)));
  }
}

}  // namespace
}  // namespace quincunx

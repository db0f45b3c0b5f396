#include "accel/structure.h"

#include <gmock/gmock.h>

#include <set>

#include "coefficient_sets.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

Classification example(int block, double isovalue) {
  const CellBounds cells = bcc7_bounds(smooth_coefficients({9, 7, 5}));
  return classify(block_bounds(cells, block), cells, std::vector{isovalue});
}

TEST(Structure, EveryNameMakesAStructureOfThatNameWithAShaderOfItsOwn) {
  std::set<std::string_view> shaders;
  for (std::string_view name : structure_names()) {
    const auto structure = make_structure(name);
    EXPECT_EQ(structure->name(), name);
    EXPECT_EQ(structure->shader(), "skip_" + std::string(name) + ".glsl");
    shaders.insert(structure->shader());
  }
  EXPECT_EQ(shaders.size(), structure_names().size());
}

TEST(Structure, EveryOneBuildsAgainAndAgainAndGivesBuffersIfItReadsAClassification) {
  for (std::string_view name : structure_names()) {
    const auto structure = make_structure(name);
    for (int block : {8, 2, 4}) {
      structure->build(example(block, 1000.0));
      const auto buffers = structure->buffers();
      EXPECT_EQ(buffers.empty(), !structure->needs_classification()) << name;
      for (const StructureBuffer& buffer : buffers) {
        EXPECT_FALSE(buffer.name.empty()) << name;
        EXPECT_FALSE(buffer.bytes.empty()) << name;
      }
    }
  }
}

TEST(Structure, GridHandsOutTheLevelsOfItsBlocksAndKeepsThem) {
  const auto grid = make_structure("grid");
  std::vector<std::uint8_t> expected;
  {
    const Classification c = example(4, 1000.0);
    EXPECT_THAT(c.level, testing::Contains(Classification::active));
    expected = c.level;
    grid->build(c);
  }
  const auto buffers = grid->buffers();
  ASSERT_EQ(buffers.size(), 1u);
  EXPECT_EQ(buffers[0].name, "gridLevel");
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(buffers[0].bytes.data());
  EXPECT_EQ(std::vector<std::uint8_t>(bytes, bytes + buffers[0].bytes.size()), expected);
}

TEST(Structure, AnUnknownNameIsRefusedNamingTheChoices) {
  try {
    make_structure("octree");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("octree"));
    for (std::string_view name : structure_names()) EXPECT_THAT(e.what(), testing::HasSubstr(std::string(name)));
  }
}

}  // namespace
}  // namespace quincunx

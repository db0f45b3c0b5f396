#include "accel/choose_skip.h"

#include <gmock/gmock.h>

#include "accel/structure.h"

namespace quincunx {
namespace {

/// Cells of values 0 or 1; `busy`: the part of them, one after another along x, that holds both.
CellBounds bounds_with(double busy) {
  CellBounds cells;
  cells.cells = glm::i64vec3(64, 32, 32);
  cells.step = 1.0 / 65535.0;
  for (std::int64_t n = 0; n < 64 * 32 * 32; ++n) {
    const bool both = double(n % 64) < busy * 64.0;
    cells.min.push_back(0);
    cells.max.push_back(both ? 65535 : 0);
  }
  return cells;
}

/// Blocks of such cells, classified for the isovalue 0.5.
Classification blocks_with(double busy) {
  const CellBounds cells = bounds_with(busy);
  return classify(block_bounds(cells, kChoiceBlock), cells, ranges_of(std::vector{0.5}));
}

TEST(ChooseSkip, LeapsOverEmptyBlocksWhereThereAreAny) {
  const SkipChoice choice = choose_skip({}, blocks_with(0.25), {});
  EXPECT_EQ(choice.config.structure, "distance");
  EXPECT_EQ(choice.config.block, 8);
  EXPECT_TRUE(choice.config.cell_test);
  EXPECT_THAT(choice.why, testing::HasSubstr("32 of 128 blocks"));
  EXPECT_THAT(choice.why, testing::HasSubstr("25.0 %"));
}

TEST(ChooseSkip, TakesTheCheapestStepWhereNearlyEveryBlockMayHoldASurface) {
  EXPECT_EQ(choose_skip({}, blocks_with(1.0), {}).config.structure, "grid");
  EXPECT_EQ(choose_skip({}, blocks_with(0.8), {}).config.structure, "distance");
}

TEST(ChooseSkip, AsksNothingInsideLargeBoxesOfAVolumeThatIsFull) {
  const SkipChoice full = choose_skip({}, blocks_with(1.0), {.volume = true});
  EXPECT_EQ(skip_label(full.config), "kdtree:shallow");
  EXPECT_FALSE(full.config.cell_test);
  EXPECT_EQ(choose_skip({}, blocks_with(0.8), {.volume = true}).config, choose_skip({}, blocks_with(0.8), {}).config);
}

TEST(ChooseSkip, KeepsWhatIsGiven) {
  const Classification blocks = blocks_with(0.25);
  SkipConfig wanted{.structure = "bvh", .cell_test = false, .clustering = Clustering::boxes};
  const SkipConfig chosen = choose_skip(wanted, blocks, {}).config;
  wanted.block = chosen.block;
  EXPECT_EQ(chosen, wanted);
  EXPECT_GT(chosen.block, 0);
  EXPECT_EQ(choose_skip({.block = 32}, blocks, {}).config.block, 32);
  EXPECT_FALSE(choose_skip({.cell_test = false}, blocks, {}).config.cell_test);
}

TEST(ChooseSkip, AlwaysCompletesToAStructureThatExists) {
  for (const double busy : {0.0, 0.01, 0.5, 1.0})
    for (const bool cpu : {true, false}) {
      const SkipChoice choice = choose_skip({}, blocks_with(busy), {.cpu = cpu});
      EXPECT_FALSE(is_open(choice.config));
      EXPECT_FALSE(choice.why.empty());
      EXPECT_EQ(make_structure(choice.config)->name(), choice.config.structure);
    }
}

TEST(ChooseSkip, KnowsWhatIsOpen) {
  EXPECT_TRUE(is_open({}));
  EXPECT_TRUE(is_open({.structure = "grid"}));
  EXPECT_TRUE(is_open({.block = 8}));
  EXPECT_FALSE(is_open({.structure = "grid", .block = 8}));
}

}  // namespace
}  // namespace quincunx

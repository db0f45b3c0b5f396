#include "accel/summed_volume.h"

#include <gmock/gmock.h>

#include <random>

#include "block_masks.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// Calls f(b) for every block of `box`.
template <class F>
void for_each_block(const BlockBox& box, F f) {
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int y = box.low.y; y < box.high.y; ++y)
      for (int x = box.low.x; x < box.high.x; ++x) f(glm::ivec3(x, y, z));
}

std::uint32_t counted(const Classification& blocks, const BlockBox& box) {
  std::uint32_t count = 0;
  for_each_block(box, [&](const glm::ivec3& b) { count += is_active(blocks, b); });
  return count;
}

/// A box of any size, empty ones included, inside `blocks`.
BlockBox random_box(const glm::ivec3& blocks, std::mt19937& random) {
  BlockBox box;
  for (int axis = 0; axis < 3; ++axis) {
    std::uniform_int_distribution<int> place(0, blocks[axis]);
    const int a = place(random), b = place(random);
    box.low[axis] = std::min(a, b), box.high[axis] = std::max(a, b);
  }
  return box;
}

TEST(SummedVolume, CountsRandomBoxesAsALoopDoes) {
  std::mt19937 random(1);
  for (const BlockMask& mask : block_masks()) {
    const SummedVolume sums(mask.blocks);
    ASSERT_EQ(sums.blocks(), glm::ivec3(mask.blocks.blocks));
    EXPECT_EQ(sums.count({glm::ivec3(0), sums.blocks()}), mask.blocks.active_blocks) << mask.name;
    for (int n = 0; n < 100; ++n) {
      const BlockBox box = random_box(sums.blocks(), random);
      const std::uint32_t count = counted(mask.blocks, box);
      EXPECT_EQ(sums.count(box), count) << mask.name;
      EXPECT_EQ(sums.empty(box), count == 0) << mask.name;
      EXPECT_EQ(sums.full(box), count == box.volume()) << mask.name;
    }
  }
}

TEST(SummedVolume, TrimsRandomBoxesToTheirActiveBlocks) {
  std::mt19937 random(2);
  for (const BlockMask& mask : block_masks()) {
    const SummedVolume sums(mask.blocks);
    for (int n = 0; n < 100; ++n) {
      const BlockBox box = random_box(sums.blocks(), random);
      const BlockBox trimmed = sums.trimmed(box);
      if (counted(mask.blocks, box) == 0) {
        EXPECT_EQ(trimmed.low, trimmed.high) << mask.name;
        continue;
      }
      BlockBox expected{box.high, box.low};
      for_each_block(box, [&](const glm::ivec3& b) {
        if (!is_active(mask.blocks, b)) return;
        expected.low = glm::min(expected.low, b);
        expected.high = glm::max(expected.high, b + 1);
      });
      EXPECT_EQ(trimmed, expected) << mask.name;
    }
  }
}

TEST(SummedVolume, ABoxWithoutBlocksIsEmptyAndFull) {
  const SummedVolume sums(filled_mask({3, 2, 4}));
  const BlockBox nothing{{3, 2, 4}, {3, 2, 4}};
  EXPECT_EQ(sums.count(nothing), 0u);
  EXPECT_TRUE(sums.empty(nothing));
  EXPECT_TRUE(sums.full(nothing));
}

TEST(SummedVolume, RefusesMoreBlocksThanItCanCount) {
  Classification blocks;
  blocks.block = 1;
  blocks.blocks = {1 << 11, 1 << 10, 1 << 11};  // 2^32; no levels: the size is looked at first
  try {
    SummedVolume sums(blocks);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("--block"));
    EXPECT_THAT(e.what(), testing::HasSubstr("2048 x 1024 x 2048"));
  }
}

}  // namespace
}  // namespace quincunx

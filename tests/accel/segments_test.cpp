#include "accel/segments.h"

#include <gtest/gtest.h>

#include "tests/accel/block_masks.h"

namespace quincunx {
namespace {

/// Whether all blocks of the volume in a cube of 2^level blocks' edge at `block` are active, or none is.
bool uniform(const Classification& c, const glm::ivec3& block, int level) {
  const glm::ivec3 low = (block >> level) << level;
  const glm::ivec3 high = glm::min(low + (1 << level), glm::ivec3(c.blocks));
  const bool first = is_active(c, low);
  for (int z = low.z; z < high.z; ++z)
    for (int y = low.y; y < high.y; ++y)
      for (int x = low.x; x < high.x; ++x)
        if (is_active(c, {x, y, z}) != first) return false;
  return true;
}

bool covers(const Classification& c, int level) { return glm::all(glm::lessThanEqual(glm::ivec3(c.blocks), glm::ivec3(1 << level))); }

TEST(Segments, LeavesAreTheLargestNodesThatAreActiveOrEmptyThroughout) {
  for (const BlockMask& mask : block_masks()) {
    SCOPED_TRACE(mask.name);
    StructureReport report;
    const Classification& c = mask.blocks;
    const std::vector<std::uint8_t> leaves = occupancy_leaves(c, report);
    ASSERT_EQ(leaves.size(), c.level.size());
    std::uint64_t active = 0;
    int finest = 64;
    for (std::size_t n = 0; n < leaves.size(); ++n) {
      const glm::ivec3 block(int(n) % int(c.blocks.x), int(n) / int(c.blocks.x) % int(c.blocks.y), int(n) / int(c.blocks.x * c.blocks.y));
      const int level = leaves[n] >> 1;
      ASSERT_EQ((leaves[n] & 1) == 1, is_active(c, block)) << n;
      ASSERT_TRUE(uniform(c, block, level)) << n;
      ASSERT_TRUE(covers(c, level) || !uniform(c, block, level + 1)) << n;
      finest = std::min(finest, level);
      active += (leaves[n] & 1) && block == (block >> level) << level;
    }
    EXPECT_EQ(report.leaves, active);
    int coarsest = 0;
    while (!covers(c, coarsest)) ++coarsest;
    EXPECT_EQ(report.depth, coarsest - finest + 1);
  }
}

TEST(Segments, OctreesOfOneActiveBlockHaveTheSiblingsOnItsWay) {
  const Classification one = make_mask({8, 8, 8}, [](const glm::ivec3& b) { return b == glm::ivec3(5, 0, 2); });
  StructureReport report;
  occupancy_leaves(one, report);
  EXPECT_EQ(report.leaves, 1u);
  EXPECT_EQ(report.nodes, 1u + 3u * 8u);  // the root, and eight on each level below
  EXPECT_EQ(report.depth, 4);
  occupancy_leaves(filled_mask({8, 8, 8}), report);
  EXPECT_EQ(report.leaves, 1u);
  EXPECT_EQ(report.nodes, 1u);
  EXPECT_EQ(report.depth, 1);
}

TEST(Segments, HandOutTheirCapacity) {
  const Segments segments({.capacity = 5});
  ASSERT_TRUE(segments.segment_pass());
  EXPECT_EQ(segments.segment_pass()->capacity, 5);
  EXPECT_EQ(segments.parameters().x, 5);
}

}  // namespace
}  // namespace quincunx

#include "accel/cluster.h"

#include <gmock/gmock.h>

#include "block_masks.h"
#include "tree_walk.h"

namespace quincunx {
namespace {

using testing::ElementsAre;

/// Whether the boxes lie inside the blocks, hold every active block once and no other.
testing::AssertionResult partition(const std::vector<BlockBox>& boxes, const Classification& blocks) {
  const glm::ivec3 n(blocks.blocks);
  std::vector<int> times(blocks.level.size());
  for (const BlockBox& box : boxes) {
    if (box.volume() <= 0 || glm::min(box.low, glm::ivec3(0)) != glm::ivec3(0) || glm::max(box.high, n) != n)
      return testing::AssertionFailure() << "a box without blocks, or outside";
    for (int z = box.low.z; z < box.high.z; ++z)
      for (int y = box.low.y; y < box.high.y; ++y)
        for (int x = box.low.x; x < box.high.x; ++x) ++times[std::size_t((z * n.y + y) * n.x + x)];
  }
  for (std::size_t b = 0; b < times.size(); ++b)
    if (times[b] != (blocks.level[b] == Classification::active))
      return testing::AssertionFailure() << "block " << b << " of level " << int(blocks.level[b]) << " is in " << times[b] << " boxes";
  return testing::AssertionSuccess();
}

/// The cubes by the definition: for each edge each position in order, each block looked at.
std::vector<BlockBox> cubes_by_hand(Classification blocks, int max_cluster) {
  const glm::ivec3 n(blocks.blocks);
  std::vector<BlockBox> cubes;
  for (int edge = max_cluster; edge >= 1; --edge)
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) {
          bool all = x + edge <= n.x && y + edge <= n.y && z + edge <= n.z;
          for (int b = 0; all && b < edge * edge * edge; ++b)
            all = is_active(blocks, {x + b % edge, y + b / edge % edge, z + b / edge / edge});
          if (!all) continue;
          for (int b = 0; b < edge * edge * edge; ++b)
            blocks.level[std::size_t(((z + b / edge / edge) * n.y + y + b / edge % edge) * n.x + x + b % edge)] = 0;
          cubes.push_back({{x, y, z}, glm::ivec3(x, y, z) + edge});
        }
  return cubes;
}

TEST(Cluster, CubesPartitionTheActiveBlocksLargestFirst) {
  for (const BlockMask& mask : block_masks())
    for (int max_cluster : {1, 3, 16}) {
      const std::vector<BlockBox> cubes = cluster_cubes(mask.blocks, max_cluster);
      EXPECT_TRUE(partition(cubes, mask.blocks)) << mask.name;
      int last = max_cluster;
      for (const BlockBox& cube : cubes) {
        EXPECT_EQ(cube.size(), glm::ivec3(cube.size().x)) << mask.name;
        EXPECT_LE(cube.size().x, last) << mask.name;
        last = cube.size().x;
      }
    }
}

TEST(Cluster, CubesAreThoseOfTheDefinition) {
  for (const BlockMask& mask : block_masks()) EXPECT_EQ(cluster_cubes(mask.blocks, 5), cubes_by_hand(mask.blocks, 5)) << mask.name;
}

TEST(Cluster, CubesTakeTheLargestThatFitsWhereverItLies) {
  // 3 x 3 x 3 in the far corner of a slab of one layer: the slab's blocks are taken after it, around it.
  const Classification blocks = make_mask({6, 6, 6}, [](const glm::ivec3& b) {
    return b.z == 5 || glm::min(b, glm::ivec3(3)) == glm::ivec3(3);
  });
  const std::vector<BlockBox> cubes = cluster_cubes(blocks, 16);
  ASSERT_EQ(cubes.size(), 1u + 27u);
  EXPECT_EQ(cubes[0], (BlockBox{{3, 3, 3}, {6, 6, 6}}));
  for (std::size_t n = 1; n < cubes.size(); ++n) EXPECT_EQ(cubes[n].volume(), 1);
}

TEST(Cluster, CubesReachTheLastLayers) {
  // 5 x 3 x 7: two cubes of edge 3 beside each other along z, a layer of 5 x 3 and columns of 2 x 3 left.
  const std::vector<BlockBox> cubes = cluster_cubes(filled_mask({5, 3, 7}), 16);
  EXPECT_EQ(cubes[0], (BlockBox{{0, 0, 0}, {3, 3, 3}}));
  EXPECT_EQ(cubes[1], (BlockBox{{0, 0, 3}, {3, 3, 6}}));
  EXPECT_EQ(cubes[2], (BlockBox{{3, 0, 0}, {5, 2, 2}}));
  EXPECT_EQ(cubes.back(), (BlockBox{{4, 2, 6}, {5, 3, 7}}));
  for (const glm::ivec3& size : {glm::ivec3(1), glm::ivec3(4), glm::ivec3(16)})
    EXPECT_THAT(cluster_cubes(filled_mask(size), 16), ElementsAre(BlockBox{{0, 0, 0}, size}));
}

TEST(Cluster, BoxesPartitionTheActiveBlocks) {
  for (const BlockMask& mask : block_masks()) EXPECT_TRUE(partition(cluster_boxes(mask.blocks), mask.blocks)) << mask.name;
}

TEST(Cluster, BoxesReachTheLastLayersAndCrossTheWordsOfARow) {
  for (const glm::ivec3& size : {glm::ivec3(5, 3, 7), {1, 1, 1}, {63, 2, 3}, {64, 2, 3}, {65, 2, 3}, {128, 3, 2}, {200, 2, 2}, {1, 70, 90}})
    EXPECT_THAT(cluster_boxes(filled_mask(size)), ElementsAre(BlockBox{{0, 0, 0}, size}));
  for (int begin : {0, 1, 62, 63, 64, 65, 126})
    for (int end : {63, 64, 65, 127, 128, 129, 130}) {
      const BlockBox box{{begin, 1, 0}, {end, 3, 2}};
      if (begin >= end) continue;
      const Classification blocks = make_mask({130, 4, 3}, [&](const glm::ivec3& b) {
        return glm::max(b, box.low) == b && glm::min(b, box.high - 1) == b;
      });
      EXPECT_THAT(cluster_boxes(blocks), ElementsAre(box));
    }
}

TEST(Cluster, BoxesCannotGrow) {
  // No layer of blocks behind a box's high faces is free at its turn: active, and in none of the boxes before it.
  for (const BlockMask& mask : block_masks()) {
    Classification left = mask.blocks;
    for (const BlockBox& box : cluster_boxes(mask.blocks)) {
      for (int axis = 0; axis < 3; ++axis) {
        BlockBox layer = box;
        layer.low[axis] = box.high[axis], layer.high[axis] = box.high[axis] + 1;
        bool grows = layer.high[axis] <= mask.blocks.blocks[axis];
        for (int z = layer.low.z; grows && z < layer.high.z; ++z)
          for (int y = layer.low.y; grows && y < layer.high.y; ++y)
            for (int x = layer.low.x; grows && x < layer.high.x; ++x) grows = is_active(left, {x, y, z});
        EXPECT_FALSE(grows) << mask.name;
      }
      for (int z = box.low.z; z < box.high.z; ++z)
        for (int y = box.low.y; y < box.high.y; ++y)
          for (int x = box.low.x; x < box.high.x; ++x)
            left.level[std::size_t((z * left.blocks.y + y) * left.blocks.x + x)] = 0;
    }
  }
}

// No theorem: greedy boxes can cut up what a few cubes would hold. On blocks such as surfaces make it holds with room.
TEST(Cluster, BoxesAreNoMoreThanTheCubes) {
  for (const BlockMask& mask : block_masks())
    EXPECT_LE(cluster_boxes(mask.blocks).size(), cluster_cubes(mask.blocks, 16).size()) << mask.name;
}

TEST(Cluster, SingleBlocksAreTheActiveOnesXFastest) {
  for (const BlockMask& mask : block_masks()) {
    const std::vector<BlockBox> singles = single_blocks(mask.blocks);
    EXPECT_TRUE(partition(singles, mask.blocks)) << mask.name;
    EXPECT_EQ(singles.size(), mask.blocks.active_blocks) << mask.name;
    EXPECT_EQ(singles, sorted(singles)) << mask.name;
  }
}

}  // namespace
}  // namespace quincunx

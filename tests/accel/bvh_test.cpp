#include "accel/bvh.h"

#include <gmock/gmock.h>

#include <cstring>
#include <random>

#include "accel/bvh_build.h"
#include "accel/cluster.h"
#include "block_masks.h"
#include "tree_walk.h"

namespace quincunx {
namespace {

/// Boxes of 1 to 5 blocks along each axis, anywhere in 1000^3, overlapping as they like.
std::vector<BlockBox> random_boxes(int count) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> place(0, 995), size(1, 5);
  std::vector<BlockBox> boxes;
  for (int n = 0; n < count; ++n) {
    const glm::ivec3 low(place(random), place(random), place(random)), extent(size(random), size(random), size(random));
    boxes.push_back({low, low + extent});
  }
  return boxes;
}

/// `count` single blocks in a row: the surface area heuristic halves it like the median.
std::vector<BlockBox> row(int count) {
  std::vector<BlockBox> boxes;
  for (int x = 0; x < count; ++x) boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  return boxes;
}

/// Expects a tree of `boxes`: every one a leaf once, inner nodes of two children that they span, as words too.
void expect_tree(const std::vector<BoxNode>& nodes, const std::vector<BlockBox>& boxes) {
  ASSERT_EQ(nodes.size(), boxes.empty() ? 0 : 2 * boxes.size() - 1);
  const BoxTree tree = flatten(nodes);
  const TreeWalk found = walk(tree);
  EXPECT_EQ(found.leaves, sorted(boxes));
  EXPECT_EQ(tree.leaves, boxes.size());
  EXPECT_EQ(found.depth, tree.depth);
  EXPECT_EQ(depth_of(nodes), boxes.size() < 2 ? tree.depth : tree.depth + 1);
  if (boxes.empty()) return;
  BlockBox all = boxes[0];
  for (const BlockBox& box : boxes) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  EXPECT_EQ(nodes[0].box, all);
}

std::vector<BlockBox> clusters(const Classification& blocks, const Bvh::Config& config) {
  if (config.clustering == Clustering::cubes) return cluster_cubes(blocks, config.max_cluster);
  return config.clustering == Clustering::boxes ? cluster_boxes(blocks) : single_blocks(blocks);
}

/// The tree in a structure's buffer.
BoxTree tree_of(const Bvh& bvh) {
  const std::vector<StructureBuffer> buffers = bvh.buffers();
  EXPECT_EQ(buffers.size(), 1u);
  BoxTree tree;
  tree.nodes.resize(buffers[0].bytes.size() / sizeof(BoxTree::Node));
  std::memcpy(tree.nodes.data(), buffers[0].bytes.data(), buffers[0].bytes.size());
  return tree;
}


TEST(Bvh, HierarchiesHoldEveryBoxOnceWhateverTheirNumber) {
  for (int count : {0, 1, 2, 3, 5, 64, 1000, 20000}) {
    const std::vector<BlockBox> boxes = random_boxes(count);
    SCOPED_TRACE(count);
    expect_tree(sah_hierarchy(boxes), boxes);
    expect_tree(median_hierarchy(boxes), boxes);
  }
  expect_tree(sah_hierarchy(row(3000)), row(3000));
}

TEST(Bvh, HierarchiesHoldBoxesThatAreAllTheSame) {
  const std::vector<BlockBox> boxes(500, BlockBox{{3, 4, 5}, {6, 7, 8}});
  expect_tree(sah_hierarchy(boxes), boxes);
  expect_tree(median_hierarchy(boxes), boxes);
}

TEST(Bvh, TheMedianHalvesTheNumber) {
  for (const auto& [count, depth] : {std::pair(1, 1), {2, 2}, {3, 3}, {4, 3}, {5, 4}, {1024, 11}, {1025, 12}})
    EXPECT_EQ(depth_of(median_hierarchy(random_boxes(count))), depth) << count;
}

TEST(Bvh, WhatWouldGetTooDeepIsHalvedAndLosesNothing) {
  const std::vector<BlockBox> boxes = random_boxes(20000);
  const int least = depth_of(median_hierarchy(boxes)) - 1;
  ASSERT_GT(depth_of(sah_hierarchy(boxes)) - 1, least);
  for (int max_depth : {least, least + 1, 48}) {
    const std::vector<BoxNode> nodes = sah_hierarchy(boxes, max_depth);
    EXPECT_LE(depth_of(nodes) - 1, max_depth);
    expect_tree(nodes, boxes);
  }
}

TEST(Bvh, TheSurfaceAreaHeuristicPartsDistantBoxes) {
  // Five blocks together and one far away: parted first, where a median would take two of the five along.
  const std::vector<BlockBox> boxes = [] {
    std::vector<BlockBox> together = row(5);
    together.push_back({{900, 900, 900}, {901, 901, 901}});
    return together;
  }();
  const std::vector<BoxNode> nodes = sah_hierarchy(boxes);
  const auto volume = [&](int child) { return nodes[std::size_t(nodes[0].child[child])].box.volume(); };
  EXPECT_EQ(std::min(volume(0), volume(1)), 1);
  EXPECT_EQ(std::max(volume(0), volume(1)), 5);
}

TEST(Bvh, ItsBufferHoldsTheClustersAndItsReportCountsThem) {
  for (const BlockMask& mask : block_masks())
    for (const Clustering clustering : {Clustering::none, Clustering::cubes, Clustering::boxes}) {
      SCOPED_TRACE(mask.name);
      const Bvh::Config config{clustering, 7};
      const std::vector<BlockBox> expected = clusters(mask.blocks, config);
      Bvh bvh(config);
      bvh.build(mask.blocks, kNoThresholds);
      const TreeWalk found = walk(tree_of(bvh));
      EXPECT_EQ(found.leaves, sorted(expected));
      const StructureReport report = bvh.report();
      EXPECT_EQ(report.leaves, expected.size());
      EXPECT_EQ(report.nodes, expected.empty() ? 0 : 2 * expected.size() - 1);
      EXPECT_EQ(report.depth, expected.size() < 2 ? int(expected.size()) : found.depth + 1);
      EXPECT_EQ(report.cluster_ms > 0.0, clustering != Clustering::none);
      EXPECT_GT(report.build_ms, 0.0);
      EXPECT_EQ(bvh.parameters(), glm::ivec4(int(expected.size()), 0, 0, 0));
    }
}

TEST(Bvh, BuildingAgainReplacesTheTreeUnderAnotherVersion) {
  Bvh bvh({Clustering::boxes});
  std::uint64_t version = 0;
  for (const glm::ivec3& size : {glm::ivec3(4, 4, 4), {1, 1, 9}, {7, 2, 3}}) {
    bvh.build(filled_mask(size), kNoThresholds);
    EXPECT_THAT(walk(tree_of(bvh)).leaves, testing::ElementsAre(BlockBox{{0, 0, 0}, size}));
    EXPECT_NE(bvh.buffers()[0].version, version);
    version = bvh.buffers()[0].version;
  }
  bvh.build(make_mask({3, 3, 3}, [](const glm::ivec3&) { return false; }), kNoThresholds);
  EXPECT_TRUE(walk(tree_of(bvh)).leaves.empty());
  EXPECT_EQ(bvh.parameters().x, 0);
  EXPECT_EQ(bvh.report().leaves, 0u);
}

TEST(Bvh, IsTheSameTreeEveryTime) {
  const std::vector<BlockBox> boxes = random_boxes(20000);
  const BoxTree first = flatten(sah_hierarchy(boxes)), second = flatten(sah_hierarchy(boxes));
  ASSERT_EQ(first.nodes.size(), second.nodes.size());
  EXPECT_EQ(std::memcmp(first.nodes.data(), second.nodes.data(), first.nodes.size() * sizeof(BoxTree::Node)), 0);
}

}  // namespace
}  // namespace quincunx

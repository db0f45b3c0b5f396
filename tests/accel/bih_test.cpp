#include "accel/bih.h"

#include <gmock/gmock.h>

#include <cstring>

#include "accel/cluster.h"
#include "block_masks.h"
#include "tree_walk.h"

namespace quincunx {
namespace {


/// The blocks of the leaves in a structure's buffer, by its words alone. Expects them between all planes above, in blocks.
struct Walked {
  const BihSkipping& structure;
  std::vector<BihNode> nodes = {};
  std::vector<BlockBox> leaves = {};
  std::uint64_t one_child = 0, reached = 0;

  void visit(std::uint32_t n, BlockBox region) {
    ++reached;
    const BihNode node = nodes.at(n);
    if (node.leaf()) {
      const glm::ivec3 block(int(node.link >> 16), int(node.planes & 0xffff), int(node.planes >> 16));
      EXPECT_EQ(node.link & 0xfffcu, 0u);
      EXPECT_TRUE(glm::all(glm::lessThanEqual(region.low, block)) && glm::all(glm::lessThan(block, region.high)));
      leaves.push_back({block, block + 1});
      return;
    }
    const int a = node.axis(), origin = structure.parameters()[a];
    const int p = origin + node.plane(0), q = origin + node.plane(1);
    if (node.one_child()) {
      ++one_child;
      region.low[a] = std::max(region.low[a], p), region.high[a] = std::min(region.high[a], q);
      if (region.low[a] < region.high[a]) visit(node.index(), region);
      return;
    }
    EXPECT_LE(p, q) << "blocks do not overlap";
    BlockBox first = region, second = region;
    first.high[a] = std::min(region.high[a], p), second.low[a] = std::max(region.low[a], q);
    visit(node.index(), first);
    visit(node.index() + 1, second);
  }
};

Walked walked(const BihSkipping& structure) {
  const std::vector<StructureBuffer> buffers = structure.buffers();
  EXPECT_EQ(buffers.size(), 1u);
  EXPECT_EQ(buffers[0].format, TexelFormat::rg32);
  Walked walk{structure};
  walk.nodes.resize(buffers[0].bytes.size() / sizeof(BihNode));
  std::memcpy(walk.nodes.data(), buffers[0].bytes.data(), buffers[0].bytes.size());
  walk.visit(0, {glm::ivec3(0), glm::ivec3(70000)});
  walk.leaves = sorted(std::move(walk.leaves));
  return walk;
}

TEST(Bih, ItsBufferHoldsTheActiveBlocksAndItsReportCountsThem) {
  for (const BlockMask& mask : block_masks()) {
    SCOPED_TRACE(mask.name);
    const std::vector<BlockBox> expected = sorted(single_blocks(mask.blocks));
    for (const int levels : {1, 4}) {
      BihSkipping bih({.chunk_levels = levels});
      bih.build(mask.blocks, kNoThresholds);
      const Walked found = walked(bih);
      EXPECT_EQ(found.leaves, expected);
      EXPECT_EQ(found.reached, found.nodes.size());
      const StructureReport report = bih.report();
      EXPECT_EQ(report.leaves, expected.size());
      EXPECT_EQ(report.nodes, expected.empty() ? 0 : found.nodes.size());
      EXPECT_EQ(report.nodes, expected.empty() ? 0 : 2 * expected.size() - 1 + report.one_child);
      EXPECT_EQ(report.one_child, expected.empty() ? 0 : found.one_child);
      EXPECT_EQ(bih.parameters().w, int(expected.size()));
      EXPECT_GT(report.build_ms, 0.0);
    }
  }
}

TEST(Bih, BuildingAgainReplacesTheTreeUnderAnotherVersion) {
  BihSkipping bih;
  std::uint64_t version = 0;
  for (const glm::ivec3& size : {glm::ivec3(4, 4, 4), {1, 1, 9}, {7, 2, 3}}) {
    bih.build(filled_mask(size), kNoThresholds);
    EXPECT_EQ(walked(bih).leaves.size(), std::size_t(size.x * size.y * size.z));
    EXPECT_NE(bih.buffers()[0].version, version);
    version = bih.buffers()[0].version;
  }
  bih.build(make_mask({3, 3, 3}, [](const glm::ivec3&) { return false; }), kNoThresholds);
  EXPECT_TRUE(walked(bih).leaves.empty());
  EXPECT_EQ(bih.report().nodes, 0u);
  EXPECT_EQ(bih.report().depth, 0);
}

TEST(Bih, MoreBlocksThanPlanesAreRefused) {
  Classification blocks = filled_mask({65536, 1, 1});
  BihSkipping bih;
  try {
    bih.build(blocks, kNoThresholds);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("65536 x 1 x 1"));
  }
}

}  // namespace
}  // namespace quincunx

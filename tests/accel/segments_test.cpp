#include "accel/segments.h"

#include <gtest/gtest.h>

#include <cstring>

#include "block_masks.h"

namespace quincunx {
namespace {

const Thresholds kNoThresholds{CellBounds{}, {}};

std::vector<std::uint8_t> bytes_of(const Segments& structure) {
  const std::vector<StructureBuffer> buffers = structure.buffers();
  EXPECT_EQ(buffers.size(), 1u);
  std::vector<std::uint8_t> nodes(buffers[0].bytes.size());
  std::memcpy(nodes.data(), buffers[0].bytes.data(), nodes.size());
  return nodes;
}

/// What the blocks low..high (exclusive) are, looked at one by one.
std::uint8_t state_of(const Classification& blocks, const glm::i64vec3& low, const glm::i64vec3& high) {
  std::size_t active = 0, all = 0;
  for (std::int64_t z = low.z; z < high.z; ++z)
    for (std::int64_t y = low.y; y < high.y; ++y)
      for (std::int64_t x = low.x; x < high.x; ++x, ++all)
        active += blocks.level[std::size_t((z * blocks.blocks.y + y) * blocks.blocks.x + x)] == Classification::active;
  return active == 0 ? Segments::empty : active == all ? Segments::full : Segments::mixed;
}

TEST(Segments, EveryNodeIsWhatAllItsBlocksAre) {
  for (const BlockMask& mask : block_masks()) {
    SCOPED_TRACE(mask.name);
    Segments structure({});
    structure.build(mask.blocks, kNoThresholds);
    const std::vector<std::uint8_t> nodes = bytes_of(structure);
    std::size_t number = 0, last_level = 0;
    std::uint64_t covered = 0;  // blocks of the largest active nodes
    std::uint64_t leaves = 0;
    const glm::i64vec3 blocks = mask.blocks.blocks;
    for (int level = 0;; ++level) {
      last_level = number;
      const std::int64_t edge = std::int64_t(1) << level;
      const glm::i64vec3 size = (blocks + (edge - 1)) / edge;
      for (std::int64_t z = 0; z < size.z; ++z)
        for (std::int64_t y = 0; y < size.y; ++y)
          for (std::int64_t x = 0; x < size.x; ++x, ++number) {
            const glm::i64vec3 low = edge * glm::i64vec3(x, y, z), high = glm::min(low + edge, blocks);
            const std::uint8_t state = state_of(mask.blocks, low, high);
            ASSERT_EQ(nodes.at(number), state) << "level " << level << ", node " << x << "," << y << "," << z;
            const glm::i64vec3 above = low / (2 * edge) * (2 * edge);
            const bool largest = size == glm::i64vec3(1) || state_of(mask.blocks, above, glm::min(above + 2 * edge, blocks)) == Segments::mixed;
            if (state != Segments::full || !largest) continue;
            ++leaves;
            covered += std::uint64_t((high.x - low.x) * (high.y - low.y) * (high.z - low.z));
          }
      if (size == glm::i64vec3(1)) break;
    }
    EXPECT_EQ(number, nodes.size());
    EXPECT_EQ(structure.parameters().y, int(last_level));
    EXPECT_EQ(structure.report().nodes, nodes.size());
    EXPECT_EQ(structure.report().leaves, leaves);
    EXPECT_EQ(covered, mask.blocks.active_blocks);
  }
}

TEST(Segments, BuildingAgainReplacesTheNodesUnderAnotherVersion) {
  Segments structure({.most_segments = 3});
  structure.build(filled_mask({4, 4, 4}), kNoThresholds);
  const std::uint64_t version = structure.buffers()[0].version;
  EXPECT_EQ(bytes_of(structure).back(), Segments::full);
  structure.build(make_mask({3, 1, 2}, [](const glm::ivec3&) { return false; }), kNoThresholds);
  EXPECT_NE(structure.buffers()[0].version, version);
  EXPECT_EQ(bytes_of(structure).back(), Segments::empty);
  EXPECT_EQ(structure.parameters().z, 3);
}

}  // namespace
}  // namespace quincunx

#include "accel/octree.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace quincunx {
namespace {

struct Node {
  std::uint16_t min, max;
};

std::vector<Node> nodes_of(const Octree& octree) {
  const std::span<const std::byte> bytes = octree.buffers().at(0).bytes;
  std::vector<Node> nodes(bytes.size() / sizeof(Node));
  std::memcpy(nodes.data(), bytes.data(), bytes.size());
  return nodes;
}

BlockBounds random_blocks(const glm::i64vec3& size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> value(0, 65535);
  BlockBounds blocks;
  blocks.blocks = size;
  for (std::int64_t n = 0; n < size.x * size.y * size.z; ++n) {
    const int a = value(random), b = value(random);
    blocks.min.push_back(std::uint16_t(std::min(a, b)));
    blocks.max.push_back(std::uint16_t(std::max(a, b)));
  }
  return blocks;
}

TEST(Octree, HoldsInEachNodeOfEachLevelTheRangeOfItsBlocks) {
  for (const glm::i64vec3& size : {glm::i64vec3(5, 9, 3), {8, 8, 8}, {1, 1, 1}, {1, 1, 13}, {17, 2, 1}}) {
    const BlockBounds blocks = random_blocks(size, 3);
    Octree octree;
    octree.prepare(blocks);
    const std::vector<Node> nodes = nodes_of(octree);
    std::size_t offset = 0;
    int level = 0;
    for (glm::i64vec3 n = size;; n = (n + std::int64_t(1)) / std::int64_t(2), ++level) {
      for (std::int64_t z = 0; z < n.z; ++z)
        for (std::int64_t y = 0; y < n.y; ++y)
          for (std::int64_t x = 0; x < n.x; ++x) {
            Node expected{65535, 0};
            const auto end = [&](std::int64_t i, std::int64_t most) { return std::min((i + 1) << level, most); };
            for (std::int64_t k = z << level; k < end(z, size.z); ++k)
              for (std::int64_t j = y << level; j < end(y, size.y); ++j)
                for (std::int64_t i = x << level; i < end(x, size.x); ++i) {
                  const std::size_t b = std::size_t((k * size.y + j) * size.x + i);
                  expected = {std::min(expected.min, blocks.min[b]), std::max(expected.max, blocks.max[b])};
                }
            const Node& node = nodes.at(offset + std::size_t((z * n.y + y) * n.x + x));
            ASSERT_EQ(node.min, expected.min) << "level " << level;
            ASSERT_EQ(node.max, expected.max) << "level " << level;
          }
      if (n == glm::i64vec3(1)) break;
      offset += std::size_t(n.x * n.y * n.z);
    }
    EXPECT_EQ(octree.parameters().x, level);
    EXPECT_EQ(octree.parameters().y, int(offset));
    EXPECT_EQ(nodes.size(), offset + 1);
  }
}

TEST(Octree, ANewIsovalueChangesItsWindowsAlone) {
  const BlockBounds blocks = random_blocks({6, 5, 4}, 9);
  CellBounds scale;
  scale.step = 1.0 / 65535.0;
  Octree octree;
  octree.prepare(blocks);
  octree.build({}, Thresholds(scale, ranges_of(std::vector{0.25})));
  const auto first = octree.buffers();
  octree.build({}, Thresholds(scale, ranges_of(std::vector{0.5, 0.75})));
  const auto second = octree.buffers();
  EXPECT_EQ(first[0].version, second[0].version);
  EXPECT_NE(first[1].version, second[1].version);
  EXPECT_EQ(octree.parameters().z, 2);
}

TEST(Octree, WindowsAreTouchedByExactlyTheBlocksThatTouchTheIsovalue) {
  CellBounds scale;
  scale.step = 1.0 / 65535.0;
  for (const double isovalue : {-1.0, 0.0, 0.3, 7.0 / 65535.0, 1.0, 2.0}) {
    const Thresholds thresholds(scale, ranges_of(std::vector{isovalue}));
    Octree octree;
    octree.prepare(random_blocks({2, 2, 2}, 1));
    octree.build({}, thresholds);
    std::uint32_t window[2];
    const auto buffers = octree.buffers();
    ASSERT_EQ(buffers[1].bytes.size(), sizeof window);
    std::memcpy(window, buffers[1].bytes.data(), sizeof window);
    for (int min = 0; min <= 65535; min += 5041)
      for (int max = min; max <= 65535; max += 7)
        ASSERT_EQ(std::uint32_t(min) < window[0] && std::uint32_t(max) >= window[1],
                  thresholds.touches(std::uint16_t(min), std::uint16_t(max)))
            << isovalue << ": " << min << ", " << max;
  }
}

}  // namespace
}  // namespace quincunx

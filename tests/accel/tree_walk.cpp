#include "tree_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace quincunx {
namespace {

BlockBox box_of(const BoxTree::Node& node) {
  const auto low = [&](int word) { return int(node.words[word] & 0xffff); };
  const auto high = [&](int word) { return int(node.words[word] >> 16); };
  return {{low(0), high(0), low(1)}, {high(1), low(2), high(2)}};
}

bool absent(const BlockBox& box) { return box == BlockBox{glm::ivec3(1), glm::ivec3(0)}; }

struct Walker {
  const BoxTree& tree;
  TreeWalk found;
  std::vector<int> visits;

  /// The union of the boxes of the pair at `pair`, `level` levels below the root.
  BlockBox visit(std::uint32_t pair, int level) {
    BlockBox both{glm::ivec3(70000), glm::ivec3(-1)};
    for (std::uint32_t n = pair; n < pair + 2; ++n) {
      ++visits[n];
      const BlockBox box = box_of(tree.nodes[n]);
      const std::uint32_t child = tree.nodes[n].words[3];
      if (absent(box)) {
        EXPECT_EQ(child, BoxTree::leaf);
        continue;
      }
      EXPECT_GT(box.volume(), 0);
      both = {glm::min(both.low, box.low), glm::max(both.high, box.high)};
      if (child == BoxTree::leaf) {
        found.leaves.push_back(box);
        found.depth = std::max(found.depth, level);
        continue;
      }
      const bool valid = child % 2 == 0 && child > n && child + 1 < tree.nodes.size();
      EXPECT_TRUE(valid) << child << " of " << n;
      if (!valid) continue;
      EXPECT_EQ(visit(child, level + 1), box);
    }
    return both;
  }
};

}  // namespace

TreeWalk walk(const BoxTree& tree) {
  Walker walker{tree, {}, std::vector<int>(tree.nodes.size())};
  EXPECT_GE(tree.nodes.size(), 2u);
  if (tree.nodes.size() >= 2) walker.visit(0, 1);
  EXPECT_EQ(std::count(walker.visits.begin(), walker.visits.end(), 1), std::ptrdiff_t(tree.nodes.size()));
  walker.found.leaves = sorted(std::move(walker.found.leaves));
  return walker.found;
}

std::vector<BlockBox> sorted(std::vector<BlockBox> boxes) {
  std::sort(boxes.begin(), boxes.end(), [](const BlockBox& a, const BlockBox& b) {
    const auto key = [](const BlockBox& c) { return std::tuple(c.low.z, c.low.y, c.low.x, c.high.z, c.high.y, c.high.x); };
    return key(a) < key(b);
  });
  return boxes;
}

}  // namespace quincunx

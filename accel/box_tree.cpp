#include "accel/box_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace quincunx {
namespace {

static_assert(sizeof(BoxTree::Node) == 16 && alignof(BoxTree::Node) == 4);

bool is_leaf(const BoxNode& node) { return node.child[0] < 0 && node.child[1] < 0; }

std::uint32_t packed(int low_half, int high_half) { return std::uint32_t(low_half) | std::uint32_t(high_half) << 16; }

BoxTree::Node packed(const BlockBox& box, std::uint32_t child) {
  const glm::ivec3 a = box.low, b = box.high;
  if (std::max({b.x, b.y, b.z}) > 0xffff)
    throw std::runtime_error(fmt::format("a tree of boxes: found a box up to block ({},{},{}), expected at most 65535", b.x, b.y, b.z));
  assert(a.x >= 0 && a.y >= 0 && a.z >= 0);
  return {{packed(a.x, a.y), packed(a.z, b.x), packed(b.y, b.z), child}};
}

BoxTree::Node absent() { return packed({glm::ivec3(1), glm::ivec3(0)}, BoxTree::leaf); }

}  // namespace

int depth_of(const std::vector<BoxNode>& nodes) {
  std::vector<int> levels(nodes.size(), 1);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const std::int32_t child : nodes[n].child)
      if (child >= 0) levels[std::size_t(child)] = levels[n] + 1;
  return nodes.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
}

BoxTree flatten(const std::vector<BoxNode>& nodes) {
  BoxTree tree;
  tree.nodes.reserve(std::max<std::size_t>(nodes.size() + 1, 2));
  if (nodes.empty() || is_leaf(nodes[0])) {
    for (const BoxNode& only : nodes) tree.nodes.push_back(packed(only.box, BoxTree::leaf));
    tree.leaves = tree.nodes.size();
    tree.depth = int(tree.leaves);
    tree.nodes.resize(2, absent());
    return tree;
  }
  // Level by level: `queue` holds the inner nodes in the order of their pairs of children, those before `level_end` up to this level.
  std::vector<std::int32_t> queue = {0};
  std::size_t level_end = 0;
  for (std::size_t n = 0; n < queue.size(); ++n) {
    if (n == level_end) {
      if (++tree.depth > BoxTree::max_depth)
        throw std::runtime_error(fmt::format("a tree of boxes: found more than {} levels", BoxTree::max_depth));
      level_end = queue.size();
    }
    for (const std::int32_t child : nodes[std::size_t(queue[n])].child) {
      if (child < 0) {
        tree.nodes.push_back(absent());
        continue;
      }
      const BoxNode& node = nodes[std::size_t(child)];
      const bool leaf = is_leaf(node);
      tree.nodes.push_back(packed(node.box, leaf ? BoxTree::leaf : std::uint32_t(2 * queue.size())));
      tree.leaves += leaf;
      if (!leaf) queue.push_back(child);
    }
  }
  assert(tree.nodes.size() == 2 * queue.size());
  return tree;
}

StructureBuffer buffer_of(const BoxTree& tree, std::uint64_t version) {
  assert(tree.nodes.size() >= 2);
  return {"boxes", TexelFormat::rgba32, std::as_bytes(std::span(tree.nodes)), version};
}

}  // namespace quincunx

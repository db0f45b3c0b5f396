// A binary tree of boxes as kernels walk it: the form that every tree of boxes takes on the device.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/block_box.h"
#include "accel/structure.h"

namespace quincunx {

/// Nodes in the form of shaders/skip_box_tree.glsl. One buffer, boxes, a texel of four 32-bit numbers a node:
///
///   offset  what
///        0  box.low.x | box.low.y << 16
///        4  box.low.z | box.high.x << 16
///        8  box.high.y | box.high.z << 16
///       12  0xffffffff for a leaf, else the number of the first of its two children; the second follows it
///
/// Boxes count blocks, high exclusive, at most 65535. The first two nodes are the children of the root, which has no node of
/// its own. A child that is not there is a leaf whose box is empty (low 1, high 0).
struct BoxTree {
  struct Node {
    std::uint32_t words[4];
  };
  static constexpr std::uint32_t leaf = 0xffffffffu;
  static constexpr int max_depth = 48;  ///< of the stack in the kernel

  std::vector<Node> nodes;  ///< at least two
  std::uint64_t leaves = 0;
  int depth = 0;  ///< nodes from a child of the root to the deepest leaf
};

/// A tree on the host, before it is flattened: children are indices into the same list, -1 for leaves.
struct BoxNode {
  BlockBox box;
  std::int32_t child[2] = {-1, -1};
};

/// Nodes from the root to the deepest leaf; 0 for none. The root is nodes[0], children come after their parents.
int depth_of(const std::vector<BoxNode>& nodes);

/// Flattens the tree whose root is nodes[0]: children of a node side by side, near the top of the tree first. An empty list is
/// the tree without leaves. Throws std::runtime_error where it is deeper than max_depth or a box passes 65535 blocks.
BoxTree flatten(const std::vector<BoxNode>& nodes);

/// The buffer of a tree.
StructureBuffer buffer_of(const BoxTree& tree, std::uint64_t version);

}  // namespace quincunx

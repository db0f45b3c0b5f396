#include "accel/leaf_list.h"

#include <algorithm>
#include <cmath>

#include "accel/kdtree_build.h"

namespace quincunx {
namespace {

/// Appends the leaves below nodes[number] in the order of every ray from `eye`, in blocks.
void append_sorted(const std::vector<BoxNode>& nodes, std::int32_t number, const glm::dvec3& eye, std::vector<std::int32_t>& order) {
  const BoxNode& node = nodes[std::size_t(number)];
  if (node.child[0] < 0) return order.push_back(number);
  // The first child is on the low side of a plane that neither crosses. A ray crosses it once, away from the eye's side.
  const BlockBox& low = nodes[std::size_t(node.child[0])].box;
  const BlockBox& high = nodes[std::size_t(node.child[1])].box;
  int axis = 0;
  while (low.high[axis] > high.low[axis]) ++axis;
  const int near = eye[axis] < low.high[axis] ? 0 : 1;
  append_sorted(nodes, node.child[near], eye, order);
  append_sorted(nodes, node.child[1 - near], eye, order);
}

std::vector<std::int32_t> sorted_leaves(const std::vector<BoxNode>& nodes, const glm::dvec3& eye) {
  std::vector<std::int32_t> order;
  if (!nodes.empty()) append_sorted(nodes, 0, eye, order);
  return order;
}

}  // namespace

void LeafList::build(const Classification& blocks, double least_share) {
  const SummedVolume sums(blocks);
  const BlockBox root = sums.trimmed({glm::ivec3(0), sums.blocks()});
  const auto share = std::int64_t(std::ceil(least_share * double(root.volume())));
  block_ = blocks.block;
  nodes_ = split_blocks(sums, {.least_volume = std::max<std::int64_t>(share, 1)});
  order_ = sorted_leaves(nodes_, glm::dvec3(0.0));
  list();
}

bool LeafList::arrange(const glm::dvec3& eye) {
  std::vector<std::int32_t> order = sorted_leaves(nodes_, eye / double(block_));
  if (order == order_) return false;
  order_ = std::move(order);
  list();
  return true;
}

/// Packs the leaves one by one: a tree of one leaf is that leaf, followed by one that is not there.
void LeafList::list() {
  std::vector<BoxTree::Node> leaves;
  for (const std::int32_t n : order_) leaves.push_back(flatten({{.box = nodes_[std::size_t(n)].box}}).nodes.front());
  boxes_ = flatten({});
  boxes_.nodes.insert(boxes_.nodes.begin(), leaves.begin(), leaves.end());
  boxes_.leaves = leaves.size();
}

StructureReport LeafList::report() const { return {.leaves = order_.size(), .nodes = nodes_.size(), .depth = depth_of(nodes_)}; }

}  // namespace quincunx

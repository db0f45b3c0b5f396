#include "accel/kdtree.h"

#include <algorithm>
#include <cmath>

#include "accel/kdtree_build.h"
#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

KdRules rules_of(const KdTree::Config& config, const Classification& blocks, const SummedVolume& sums) {
  if (config.depth == KdDepth::deep) {
    const std::int64_t cells = std::int64_t(blocks.block) * blocks.block * blocks.block;
    return {.leaf_volume = config.leaf_cells / cells, .halve = true, .max_depth = BoxTree::max_depth};
  }
  const BlockBox root = sums.trimmed({glm::ivec3(0), sums.blocks()});
  const auto share = std::int64_t(std::ceil(config.least_share * double(root.volume())));
  return {.least_volume = std::max<std::int64_t>(share, 1)};
}

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

}  // namespace

std::string_view KdTree::shader() const {
  return config_.depth == KdDepth::deep ? "skip_box_tree.glsl" : "skip_box_list.glsl";
}

void KdTree::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  const SummedVolume sums(blocks);
  std::vector<BoxNode> nodes = split_blocks(sums, rules_of(config_, blocks, sums));
  block_ = blocks.block;
  report_ = {.leaves = (nodes.size() + 1) / 2, .nodes = nodes.size(), .depth = depth_of(nodes)};
  ++version_;
  if (config_.depth == KdDepth::deep) {
    tree_ = flatten(nodes);
  } else {
    nodes_ = std::move(nodes);
    order_.clear();
    if (!nodes_.empty()) append_sorted(nodes_, 0, glm::dvec3(0.0), order_);
    list_leaves();
  }
  report_.build_ms = watch.ms();
}

void KdTree::arrange(const glm::dvec3& eye) {
  if (nodes_.empty()) return;
  std::vector<std::int32_t> order;
  append_sorted(nodes_, 0, eye / double(block_), order);
  if (order == order_) return;
  order_ = std::move(order);
  list_leaves();
  ++version_;
}

/// Packs the leaves one by one: a tree of one leaf is that leaf, followed by one that is not there.
void KdTree::list_leaves() {
  std::vector<BoxTree::Node> list;
  for (const std::int32_t n : order_) list.push_back(flatten({{.box = nodes_[std::size_t(n)].box}}).nodes.front());
  tree_ = flatten({});
  tree_.nodes.insert(tree_.nodes.begin(), list.begin(), list.end());
  tree_.leaves = list.size();
}

glm::ivec4 KdTree::parameters() const { return {int(report_.leaves), 0, 0, 0}; }

}  // namespace quincunx

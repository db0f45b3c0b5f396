#include "accel/bih.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "accel/cluster.h"
#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

/// The only node of a tree over nothing: its child, which nothing reaches, begins behind where it ends.
constexpr BihNode kEmpty{BihNode::one_child_bit, 1};

BihNode leaf_of(const glm::ivec3& block) {
  return {BihNode::leaf_axis | std::uint32_t(block.x) << 16, std::uint32_t(block.y) | std::uint32_t(block.z) << 16};
}

void check_extents(const glm::ivec3& blocks) {
  if (std::max({blocks.x, blocks.y, blocks.z}) > 0xffff)
    throw std::runtime_error(fmt::format("a bounding interval hierarchy: found {} x {} x {} blocks, expected at most 65535 along each axis", blocks.x, blocks.y, blocks.z));
}

}  // namespace

void BihSkipping::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  check_extents(blocks.blocks);
  const std::vector<BlockBox> active = single_blocks(blocks);
  std::vector<BihBox> boxes(active.size());
  std::ranges::transform(active, boxes.begin(), [](const BlockBox& b) { return BihBox{glm::vec3(b.low), glm::vec3(b.high)}; });
  // Halves of halves, never medians, which may leave children that overlap: 16 along each axis part 65536 blocks.
  Bih bih = build_bih(boxes, {.chunk_levels = config_.chunk_levels, .max_forks = 2 * stack, .least_step = 1.0});
  if (bih.forks > stack) throw std::runtime_error(fmt::format("a bounding interval hierarchy: found {} levels that part blocks, expected at most {}", bih.forks, stack));
  assert(bih.step == glm::dvec3(1.0));
  for (BihNode& node : bih.nodes)
    if (node.leaf()) node = leaf_of(active[bih.order[node.index()]].low);
  nodes_ = std::move(bih.nodes);
  if (nodes_.empty()) nodes_.push_back(kEmpty);
  parameters_ = glm::ivec4(glm::ivec3(bih.low), int(bih.leaves));
  report_ = {.leaves = bih.leaves, .nodes = active.empty() ? 0 : nodes_.size(), .one_child = bih.one_child, .depth = bih.depth, .build_ms = watch.ms()};
  ++version_;
}

std::vector<StructureBuffer> BihSkipping::buffers() const {
  assert(!nodes_.empty());
  return {{"bihNodes", TexelFormat::rg32, std::as_bytes(std::span(nodes_)), version_}};
}

}  // namespace quincunx

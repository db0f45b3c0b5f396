#include "accel/kdtree.h"

#include "accel/kdtree_build.h"
#include "lattice/stopwatch.h"

namespace quincunx {

std::string_view KdTree::shader() const {
  return config_.depth == KdDepth::deep ? "skip_box_tree.glsl" : "skip_box_list.glsl";
}

void KdTree::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  ++version_;
  if (config_.depth == KdDepth::deep) {
    const std::int64_t cells = std::int64_t(blocks.block) * blocks.block * blocks.block;
    const KdRules rules{.leaf_volume = config_.leaf_cells / cells, .halve = true, .max_depth = BoxTree::max_depth};
    const std::vector<BoxNode> nodes = split_blocks(SummedVolume(blocks), rules);
    report_ = {.leaves = (nodes.size() + 1) / 2, .nodes = nodes.size(), .depth = depth_of(nodes)};
    tree_ = flatten(nodes);
  } else {
    list_.build(blocks, config_.least_share);
    report_ = list_.report();
  }
  report_.build_ms = watch.ms();
}

void KdTree::arrange(const glm::dvec3& eye) {
  if (list_.arrange(eye)) ++version_;
}

std::vector<StructureBuffer> KdTree::buffers() const {
  return {buffer_of(config_.depth == KdDepth::deep ? tree_ : list_.boxes(), version_)};
}

glm::ivec4 KdTree::parameters() const { return {int(report_.leaves), 0, 0, 0}; }

}  // namespace quincunx

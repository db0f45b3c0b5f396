#include "accel/bvh.h"

#include "accel/bvh_build.h"
#include "accel/cluster.h"
#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

std::vector<BlockBox> clusters(const Classification& blocks, const Bvh::Config& config) {
  switch (config.clustering) {
    case Clustering::cubes: return cluster_cubes(blocks, config.max_cluster);
    case Clustering::boxes: return cluster_boxes(blocks);
    case Clustering::none: break;
  }
  return single_blocks(blocks);
}

}  // namespace

void Bvh::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  const std::vector<BlockBox> boxes = clusters(blocks, config_);
  const double cluster_ms = config_.clustering == Clustering::none ? 0.0 : watch.ms();
  const std::vector<BoxNode> nodes = sah_hierarchy(boxes);
  tree_ = flatten(nodes);
  ++version_;
  report_ = {.leaves = tree_.leaves,
             .nodes = nodes.size(),
             .depth = depth_of(nodes),
             .cluster_ms = cluster_ms,
             .build_ms = watch.ms() - cluster_ms};
}

glm::ivec4 Bvh::parameters() const { return glm::ivec4(int(tree_.leaves), 0, 0, 0); }

}  // namespace quincunx

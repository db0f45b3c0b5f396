#include "bench/cluster_measure.h"

#include <utility>

#include "accel/bvh.h"

namespace quincunx {
namespace {

void measure(const Classification& blocks, const Bvh::Config& config, ClusterCost& cost) {
  Bvh tree(config);
  tree.build(blocks, Thresholds({}, {}));  // a hierarchy asks for no isovalue
  const StructureReport report = tree.report();
  cost.leaves = report.leaves;
  cost.cluster_ms.push_back(report.cluster_ms);
  cost.build_ms.push_back(report.build_ms);
}

}  // namespace

std::vector<double> ClusterLine::speedups() const {
  std::vector<double> ratios;
  for (std::size_t n = 0; n < boxes.cluster_ms.size(); ++n) ratios.push_back(cubes.cluster_ms[n] / boxes.cluster_ms[n]);
  return ratios;
}

ClusterLine measure_clusters(std::string mask, const Classification& blocks, int max_cluster, int rounds) {
  ClusterLine line{.mask = std::move(mask), .blocks = blocks.blocks, .active = blocks.active_blocks, .single = {}, .cubes = {}, .boxes = {}};
  for (int round = 0; round < rounds; ++round) {
    measure(blocks, {.clustering = Clustering::none}, line.single);
    measure(blocks, {.clustering = Clustering::cubes, .max_cluster = max_cluster}, line.cubes);
    measure(blocks, {.clustering = Clustering::boxes}, line.boxes);
  }
  return line;
}

}  // namespace quincunx

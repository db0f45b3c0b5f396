// The region clustering of the literature against ours, on one mask of blocks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accel/classification.h"

namespace quincunx {

/// A bounding volume hierarchy (accel/bvh.h) over one kind of leaves.
struct ClusterCost {
  std::uint64_t leaves = 0;
  std::vector<double> cluster_ms;  ///< one a round; 0 for single blocks
  std::vector<double> build_ms;    ///< the tree over the leaves, one a round
};

/// What was measured on one mask.
struct ClusterLine {
  std::string mask;
  glm::i64vec3 blocks{0};
  std::uint64_t active = 0;
  ClusterCost single, cubes, boxes;  ///< single_blocks, cluster_cubes, cluster_boxes

  /// The part of the active blocks' number that leaves remain; 0 where none is active.
  double part(const ClusterCost& cost) const { return active == 0 ? 0.0 : double(cost.leaves) / double(active); }
  /// How many times as fast as cubes boxes are made: one for each round.
  std::vector<double> speedups() const;
};

/// Builds the three hierarchies `rounds` times in turns, so that a machine that slows down favours none.
ClusterLine measure_clusters(std::string mask, const Classification& blocks, int max_cluster, int rounds);

}  // namespace quincunx

// How empty space is skipped. None of it changes a pixel.
#pragma once

#include <string>

namespace quincunx {

/// What the boxes of a bounding volume hierarchy are: active blocks, or clusters of them (accel/cluster.h).
enum class Clustering { none, cubes, boxes };

/// How far a k-d tree splits: to a few large leaves, or down to a few samples (accel/kdtree.h).
enum class KdDepth { shallow, deep };

/// What the grid of a hybrid grid holds: minima and maxima, which kernels compare with what can be seen, or whether they meet it (accel/hybrid.h).
enum class HybridGrid { mm, pc };

/// How blocks and cells are compared with what can be seen (accel/range_query.h): exactly, or as published, by a table or a tree over
/// 4096 entries, which hold a little more to be visible.
enum class RangeQueryKind { intervals, table, irt };

struct SkipConfig {
  std::string structure = "auto";  ///< a name of structure_names(), or "auto": what fits the scene (accel/choose_skip.h)
  int block = 0;                   ///< edge of a block in cells, a power of two, 1..256; 0: what fits
  bool cell_test = true;           ///< a last test of single cells inside the intervals (occupancy bits); not for none
  Clustering clustering = Clustering::none;  ///< of bvh
  int max_cluster = 16;                      ///< of Clustering::cubes: the largest edge in blocks, 1..256
  KdDepth kd = KdDepth::deep;                ///< of kdtree
  double least_leaf = 0.1;                   ///< of KdDepth::shallow and hybrid: no leaf is smaller than this part of the root's volume, above 0, at most 1
  HybridGrid hybrid = HybridGrid::pc;        ///< of hybrid
  int max_segments = 16;                     ///< of segments: the most that a ray's list holds, 1..64
  RangeQueryKind range_query = RangeQueryKind::intervals;  ///< not of the blocks of octree and HybridGrid::mm, which kernels compare themselves

  bool operator==(const SkipConfig&) const = default;
};

}  // namespace quincunx

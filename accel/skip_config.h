// How empty space is skipped. None of it changes a pixel.
#pragma once

#include <string>

namespace quincunx {

/// What the boxes of a bounding volume hierarchy are: active blocks, or clusters of them (accel/cluster.h).
enum class Clustering { none, cubes, boxes };

/// How far a k-d tree splits: to a few large leaves, or down to a few samples (accel/kdtree.h).
enum class KdDepth { shallow, deep };

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
  int max_segments = 16;                     ///< of segments: the most that a ray's list holds, 1..64
  RangeQueryKind range_query = RangeQueryKind::intervals;  ///< not of octree, which compares inside the kernel

  bool operator==(const SkipConfig&) const = default;
};

}  // namespace quincunx

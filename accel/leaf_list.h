// The leaves of a shallow k-d tree (accel/kdtree.h), in the order in which every ray from the eye meets them.
#pragma once

#include <vector>

#include "accel/box_tree.h"
#include "accel/summed_volume.h"

namespace quincunx {

/// Of each cut of the tree the eye's side comes first, so that one list is in the order of every ray from the eye.
class LeafList {
 public:
  /// The tree over the active blocks, in order for an eye at the origin. No leaf is smaller than `least_share` (above 0, at most 1) of the
  /// root's volume. Throws InputError as SummedVolume does.
  void build(const Classification& blocks, double least_share);
  /// Sorts the leaves for `eye` (lattice coordinates); false where they were in that order.
  bool arrange(const glm::dvec3& eye);

  /// As kernels read them: nodes 0 .. leaves - 1 are the leaves in order, at least one that is not there follows.
  const BoxTree& boxes() const { return boxes_; }
  /// leaves, nodes and depth of the tree.
  StructureReport report() const;

 private:
  void list();

  int block_ = 1;                    ///< edge of a block in cells
  std::vector<BoxNode> nodes_;       ///< as split_blocks returns them
  std::vector<std::int32_t> order_;  ///< the leaves in nodes_, front to back
  BoxTree boxes_;
};

}  // namespace quincunx

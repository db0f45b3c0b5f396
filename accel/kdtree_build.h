// The splits of a k-d tree over the summed volume (accel/kdtree.h).
#pragma once

#include <cstdint>
#include <vector>

#include "accel/box_tree.h"
#include "accel/summed_volume.h"

namespace quincunx {

/// When a box is split.
struct KdRules {
  std::int64_t leaf_volume = 0;   ///< in blocks: boxes of this volume or less stay whole
  std::int64_t least_volume = 1;  ///< in blocks: of each of the two boxes a plane makes, or it is not taken
  bool halve = false;             ///< whether a box that no plane makes smaller is cut in the middle of its longest axis
  int max_depth = 1 << 30;        ///< nodes below the root on the way to any leaf, if `halve`: where only halving keeps to
                                  ///< it, boxes are halved
};

/// The tree of the trimmed boxes of `sums`; the root first, every node before its children, the first child on the low side of the
/// plane between them. Empty where no block is active. A box is cut by the plane that leaves the least volume in the trimmed
/// boxes of the two sides, if that is less than its own; among equals by the one whose sides differ least, then by the lowest
/// axis and plane. Boxes full of active blocks stay whole. Parallel; the nodes are a function of the blocks alone.
std::vector<BoxNode> split_blocks(const SummedVolume& sums, const KdRules& rules);

}  // namespace quincunx

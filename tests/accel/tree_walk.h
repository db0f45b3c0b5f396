// Trees of boxes read back from the words of the device.
#pragma once

#include <vector>

#include "accel/box_tree.h"

namespace quincunx {

struct TreeWalk {
  std::vector<BlockBox> leaves;  ///< without the absent ones, sorted
  int depth = 0;                 ///< as BoxTree::depth
};

/// Walks the tree from the root over nodes[...].words alone. Expects, as test failures: nodes reached once each and all of them, children
/// in pairs behind their parent, and inside its box, which they span.
TreeWalk walk(const BoxTree& tree);

/// In one order, to compare sets of boxes.
std::vector<BlockBox> sorted(std::vector<BlockBox> boxes);

}  // namespace quincunx

// Hierarchies over boxes.
#pragma once

#include <vector>

#include "accel/box_tree.h"

namespace quincunx {

/// A binary tree whose leaves are `boxes`, each once, in no order; the box of any other node is the union of its children's.
/// The root is the first node, children come after their parents; no nodes for no boxes. Split by Embree's binned surface area
/// heuristic; where that would take a leaf more than max_depth levels below the root, by median_hierarchy.
/// `max_depth`: at least the depth of median_hierarchy. Throws std::runtime_error with Embree's text where that fails.
std::vector<BoxNode> sah_hierarchy(const std::vector<BlockBox>& boxes, int max_depth = BoxTree::max_depth);

/// The same halved again and again at the median of the boxes' middles along the longest axis: ceil(log2(boxes)) levels below the
/// root.
std::vector<BoxNode> median_hierarchy(const std::vector<BlockBox>& boxes);

}  // namespace quincunx

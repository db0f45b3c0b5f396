// Bounding interval hierarchies over boxes of any kind.
//
// C. Waechter, A. Keller, "Instant Ray Tracing: The Bounding Interval Hierarchy", Eurographics Symposium on Rendering 2006,
// doi:10.2312/EGWR/EGSR06/139-149; for volumes M. Kinkelin, "GPU Volume Raycasting using Bounding Interval Hierarchies", student
// project, TU Wien, 2009.
//
// Departures. Planes are 16-bit numbers on a grid over the root's box instead of floats. An empty side makes no node by itself: the half that
// is left is halved again, and one node with one child cuts the empty space off where it is worth it (BihConfig::trim). Boxes that
// halving does not part in time are parted at the median of their middles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace quincunx {

/// A box to build over: low <= high, finite. In any space.
struct BihBox {
  glm::vec3 low{0.0f}, high{0.0f};
};

/// A node as kernels walk it.
///
///   offset  bits   what
///        0  0-1    axis of its planes, 0 to 2; 3 for a leaf
///        0  2      set in a node with one child
///        0  3-31   number of the first child, the second follows it; of a leaf: the first of its boxes in Bih::order
///        4  0-15   two children: where the first one ends. One child: where it begins
///        4  16-31  two children: where the second one begins. One child: where it ends
///        4  0-31   of a leaf: its boxes
///
/// The first child lies at or before its plane, the second one at or behind its own; they may overlap, or leave a gap that is empty.
struct BihNode {
  static constexpr std::uint32_t leaf_axis = 3, one_child_bit = 4;
  static constexpr int index_shift = 3;
  static constexpr std::uint32_t most = std::uint32_t(1) << 29;  ///< numbers of nodes and boxes are below

  std::uint32_t link = leaf_axis;
  std::uint32_t planes = 0;

  bool leaf() const { return axis() == int(leaf_axis); }
  int axis() const { return int(link & 3u); }
  bool one_child() const { return !leaf() && (link & one_child_bit) != 0; }
  std::uint32_t index() const { return link >> index_shift; }
  std::uint32_t count() const { return planes; }  ///< of a leaf
  int plane(int which) const { return int(planes >> 16 * which & 0xffffu); }
};
static_assert(sizeof(BihNode) == 8 && alignof(BihNode) == 4);
static_assert(offsetof(BihNode, link) == 0 && offsetof(BihNode, planes) == 4);

struct BihConfig {
  int leaf_size = 1;        ///< boxes of a leaf, at most
  int chunk_levels = 4;     ///< levels of a chunk, which is stored breadth-first; 1: depth-first, many: breadth-first
  int max_forks = 48;       ///< nodes with two children above any leaf, at most: the entries of a walk's stack
  double trim = 1.0 / 1.3;  ///< a node with one child cuts an axis to what it holds where less than this part is left; 0: never
  double least_step = 0.0;  ///< between planes, a power of two: whole numbers stay exact with 1; 0: as fine as 16 bits allow
};

struct Bih {
  std::vector<BihNode> nodes;        ///< the root first, children behind their parents; none over no boxes
  std::vector<std::uint32_t> order;  ///< numbers of the boxes in the order of the leaves
  glm::dvec3 low{0.0}, high{0.0};    ///< the root's box: holds every box, not cut by any node
  glm::dvec3 step{1.0};              ///< plane q of axis a is at low[a] + q step[a], a float
  std::uint64_t leaves = 0;
  std::uint64_t one_child = 0;  ///< nodes with one child
  int depth = 0;                ///< nodes from the root to the deepest leaf
  int forks = 0;                ///< nodes with two children above a leaf, at most

  std::uint64_t bytes() const { return nodes.size() * sizeof(BihNode); }
  double plane_at(int axis, int plane) const { return low[axis] + plane * step[axis]; }
};

/// The hierarchy over `boxes`, each in one leaf. A node's box is halved along its longest axis; boxes belong to the side of their middles;
/// planes are rounded outwards. Each time the same for the same boxes; config.chunk_levels changes nothing but where nodes lie.
/// Throws std::runtime_error where there are 2^29 nodes or more, or where max_forks is too few for the boxes.
Bih build_bih(std::span<const BihBox> boxes, const BihConfig& config);

}  // namespace quincunx

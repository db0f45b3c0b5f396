#include "accel/kdtree_build.h"

#include <tbb/parallel_invoke.h>

#include <bit>
#include <cstdlib>
#include <optional>
#include <tuple>

namespace quincunx {
namespace {

constexpr std::int64_t kParallelVolume = 4096;  // blocks below which a subtree is one task

struct Plane {
  int axis, position;  // between the blocks position - 1 and position
};

/// Moves the faces of `hull`, the trimmed box of a part of `reach`, outwards until it is the trimmed box of all of it.
void widen(BlockBox& hull, const BlockBox& reach, const SummedVolume& sums) {
  for (int axis = 0; axis < 3; ++axis) {
    BlockBox beyond = reach;
    beyond.high[axis] = hull.low[axis];
    while (beyond.high[axis] > reach.low[axis] && !sums.empty(beyond)) --beyond.high[axis];
    hull.low[axis] = beyond.high[axis];
    beyond = reach;
    beyond.low[axis] = hull.high[axis];
    while (beyond.low[axis] < reach.high[axis] && !sums.empty(beyond)) ++beyond.low[axis];
    hull.high[axis] = beyond.low[axis];
  }
}

/// Volumes of the trimmed part of `box`, itself trimmed, on one side of each plane of `axis` strictly inside, by position -
/// box.low[axis] - 1. side 0: below the plane, 1: above. The planes are taken outwards from that side's face, so that each
/// face of the part moves in one direction only.
void sweep(const BlockBox& box, int axis, int side, const SummedVolume& sums, std::vector<std::int64_t>& volumes) {
  const int planes = box.high[axis] - box.low[axis] - 1;
  volumes.resize(std::size_t(planes));
  BlockBox reach = box, hull;
  for (int i = 0; i < planes; ++i) {
    const int number = side == 0 ? i : planes - 1 - i;
    (side == 0 ? reach.high : reach.low)[axis] = box.low[axis] + 1 + number;
    if (i == 0) hull = sums.trimmed(reach);
    else widen(hull, reach, sums);
    volumes[std::size_t(number)] = hull.volume();
  }
}

struct Builder {
  const SummedVolume& sums;
  const KdRules& rules;

  /// The plane that removes most, if any removes something.
  std::optional<Plane> best_plane(const BlockBox& box) const {
    std::optional<Plane> best;
    std::tuple<std::int64_t, std::int64_t> least{box.volume(), -1};  // of volume and imbalance; -1: a gain or nothing
    std::vector<std::int64_t> below, above;
    for (int axis = 0; axis < 3; ++axis) {
      sweep(box, axis, 0, sums, below);
      sweep(box, axis, 1, sums, above);
      for (std::size_t i = 0; i < below.size(); ++i) {
        if (below[i] < rules.least_volume || above[i] < rules.least_volume) continue;
        const std::tuple cost{below[i] + above[i], std::abs(below[i] - above[i])};
        if (cost < least) least = cost, best = Plane{axis, box.low[axis] + 1 + int(i)};
      }
    }
    return best;
  }

  /// The plane to cut a trimmed box by, if it is cut at all. `below`: how many nodes may follow on the way to a leaf.
  std::optional<Plane> plane(const BlockBox& box, int below) const {
    if (box.volume() <= rules.leaf_volume || sums.full(box)) return {};
    const glm::ivec3 size = box.size();
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const Plane middle{longest, box.low[longest] + size[longest] / 2};
    if (rules.halve) {
      int halvings = 0;  // that leave single blocks
      for (int axis = 0; axis < 3; ++axis) halvings += std::bit_width(unsigned(size[axis] - 1));
      if (halvings >= below) return middle;
    }
    const auto best = best_plane(box);
    return best || !rules.halve ? best : middle;
  }

  /// Appends the tree of a trimmed box.
  void append(const BlockBox& box, int below, std::vector<BoxNode>& nodes) const {
    const std::size_t root = nodes.size();
    nodes.push_back({.box = box});
    const auto cut = plane(box, below);
    if (!cut) return;
    BlockBox low = box, high = box;
    low.high[cut->axis] = high.low[cut->axis] = cut->position;
    low = sums.trimmed(low);
    high = sums.trimmed(high);

    nodes[root].child[0] = std::int32_t(nodes.size());
    if (box.volume() < kParallelVolume) {
      append(low, below - 1, nodes);
      nodes[root].child[1] = std::int32_t(nodes.size());
      append(high, below - 1, nodes);
      return;
    }
    std::vector<BoxNode> others;
    tbb::parallel_invoke([&] { append(low, below - 1, nodes); }, [&] { append(high, below - 1, others); });
    const auto offset = std::int32_t(nodes.size());
    nodes[root].child[1] = offset;
    for (BoxNode node : others) {
      for (std::int32_t& child : node.child) child += child < 0 ? 0 : offset;
      nodes.push_back(node);
    }
  }
};

}  // namespace

std::vector<BoxNode> split_blocks(const SummedVolume& sums, const KdRules& rules) {
  const BlockBox root = sums.trimmed({glm::ivec3(0), sums.blocks()});
  std::vector<BoxNode> nodes;
  if (root.volume() > 0) Builder{sums, rules}.append(root, rules.max_depth, nodes);
  return nodes;
}

}  // namespace quincunx

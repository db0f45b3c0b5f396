#include "accel/bih_build.h"

#include <fmt/format.h>
#include <tbb/concurrent_vector.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace quincunx {
namespace {

constexpr int kLastPlane = 0xffff;
constexpr std::size_t kParallel = 4096;  // boxes of a subtree that is worth a task

struct Box {
  glm::dvec3 low, high;
};
/// In planes.
struct Region {
  glm::ivec3 low, high;
};
struct Grid {
  glm::dvec3 low, high, step;

  int at_or_below(int axis, double v) const {
    int q = std::clamp(int(std::floor((v - low[axis]) / step[axis])), 0, kLastPlane);
    while (q > 0 && low[axis] + q * step[axis] > v) --q;
    return q;
  }
  int at_or_above(int axis, double v) const {
    int q = std::clamp(int(std::ceil((v - low[axis]) / step[axis])), 0, kLastPlane);
    while (q < kLastPlane && low[axis] + q * step[axis] < v) ++q;
    return q;
  }
};

/// Powers of two apart, so that every plane is a float and whole numbers stay exact where steps are at most 1.
Grid grid_over(const Box& box, double least_step) {
  Grid grid{box.low, box.high, glm::dvec3(1.0)};
  for (int a = 0; a < 3; ++a) {
    const double largest = std::max({std::abs(box.low[a]), std::abs(box.high[a]), 1e-30});
    double step = std::max(least_step, std::ldexp(1.0, std::ilogb(largest) - 22));
    const auto fit = [&] {
      grid.low[a] = std::floor(box.low[a] / step) * step;
      grid.high[a] = std::ceil(box.high[a] / step) * step;
      return (grid.high[a] - grid.low[a]) / step <= kLastPlane;
    };
    while (!fit()) step *= 2.0;
    grid.step[a] = step;
  }
  return grid;
}

/// A node before it has its place.
struct Made {
  int axis = int(BihNode::leaf_axis);
  std::array<int, 2> plane{0, 0};
  std::array<std::uint32_t, 2> child{0, 0};
  int children = 0;
  std::uint32_t first = 0, count = 0;  // of a leaf
};

/// Boxes sorted to two sides of an axis.
struct Parts {
  std::size_t first;  // how many are on the first side
  int axis;
  bool by_median;
};

int levels_to_halve(std::size_t boxes, int leaf_size) {
  const std::size_t leaves = (boxes + std::size_t(leaf_size) - 1) / std::size_t(leaf_size);
  return int(std::bit_width(leaves - 1));
}

int longest(const glm::dvec3& size) { return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2; }

class Builder {
 public:
  Builder(std::span<const BihBox> boxes, const BihConfig& config) : boxes_(boxes), config_(config), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    const Box all = bounds(order_);
    grid_ = grid_over(all, config.least_step);
    Region region{glm::ivec3(0), glm::ivec3(0)};
    for (int a = 0; a < 3; ++a) region.high[a] = grid_.at_or_above(a, grid_.high[a]);
    root_ = build(order_, all, all, region, config.max_forks);
  }

  Bih laid_out() &&;

 private:
  using Order = std::span<std::uint32_t>;

  Box box(std::uint32_t n) const { return {glm::dvec3(boxes_[n].low), glm::dvec3(boxes_[n].high)}; }
  glm::dvec3 middle(std::uint32_t n) const { return 0.5 * (glm::dvec3(boxes_[n].low) + glm::dvec3(boxes_[n].high)); }
  Box bounds(Order order) const {
    Box all = box(order[0]);
    for (const std::uint32_t n : order) all = {glm::min(all.low, box(n).low), glm::max(all.high, box(n).high)};
    return all;
  }
  Box middles(Order order) const {
    Box all{middle(order[0]), middle(order[0])};
    for (const std::uint32_t n : order) all = {glm::min(all.low, middle(n)), glm::max(all.high, middle(n))};
    return all;
  }
  std::uint32_t add(const Made& node) { return std::uint32_t(made_.push_back(node) - made_.begin()); }

  std::uint32_t build(Order order, const Box& content, const Box& halved, Region region, int forks_left);
  std::uint32_t leaf(Order order);
  std::uint32_t fork(Order order, Box halved, const Region& region, int forks_left);
  Parts part(Order order, Box& halved, int forks_left) const;
  Parts median(Order order, const Box& middles) const;

  std::span<const BihBox> boxes_;
  BihConfig config_;
  std::vector<std::uint32_t> order_;
  Grid grid_;
  tbb::concurrent_vector<Made> made_;
  std::uint32_t root_ = 0;
};

/// Sorts the boxes to two sides, neither of them empty. `halved`, which is halved until that is so, becomes the box whose halves they are.
Parts Builder::part(Order order, Box& halved, int forks_left) const {
  const Box middles = this->middles(order);
  if (forks_left <= levels_to_halve(order.size(), config_.leaf_size) || middles.low == middles.high) return median(order, middles);
  Box box = halved;
  for (int turn = 0; turn < 3 * 64; ++turn) {
    const int axis = longest(box.high - box.low);
    const double at = 0.5 * (box.low[axis] + box.high[axis]);
    if (middles.low[axis] < at && middles.high[axis] >= at) {
      halved = box;
      const auto before = [&](std::uint32_t n) { return middle(n)[axis] < at; };
      return {std::size_t(std::partition(order.begin(), order.end(), before) - order.begin()), axis, false};
    }
    (middles.high[axis] < at ? box.high : box.low)[axis] = at;
  }
  return median(order, middles);
}

Parts Builder::median(Order order, const Box& middles) const {
  const int axis = longest(middles.high - middles.low);
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return std::pair(middle(a)[axis], a) < std::pair(middle(b)[axis], b); };
  const std::size_t half = order.size() / 2;
  std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(half), order.end(), before);
  return {half, axis, true};
}

/// Boxes `order`, whose bounds are `content`, below planes that have cut the root's box to `region`: nodes with one child where these
/// cut off enough, and the node that they lead to.
std::uint32_t Builder::build(Order order, const Box& content, const Box& halved, Region region, int forks_left) {
  std::uint32_t top = 0, above = 0;
  int trimmed = 0;
  for (int a = 0; a < 3 && order.size() > 1; ++a) {
    const int low = grid_.at_or_below(a, content.low[a]), high = grid_.at_or_above(a, content.high[a]);
    if (!(high - low < config_.trim * (region.high[a] - region.low[a]))) continue;
    const std::uint32_t node = add({.axis = a, .plane = {low, high}, .child = {0, 0}, .children = 1, .first = 0, .count = 0});
    (trimmed++ == 0 ? top : made_[above].child[0]) = node;
    above = node;
    region.low[a] = low, region.high[a] = high;
  }
  const std::uint32_t node = order.size() <= std::size_t(config_.leaf_size) ? leaf(order) : fork(order, halved, region, forks_left);
  if (trimmed == 0) return node;
  made_[above].child[0] = node;
  return top;
}

std::uint32_t Builder::leaf(Order order) {
  Made node;
  node.first = std::uint32_t(order.data() - order_.data());
  node.count = std::uint32_t(order.size());
  return add(node);
}

std::uint32_t Builder::fork(Order order, Box halved, const Region& region, int forks_left) {
  const auto [number, axis, by_median] = part(order, halved, forks_left);
  const Order first = order.first(number), second = order.subspan(number);
  const Box a = bounds(first), b = bounds(second);
  Made node{.axis = axis, .plane = {grid_.at_or_above(axis, a.high[axis]), grid_.at_or_below(axis, b.low[axis])}, .child = {0, 0}, .children = 2, .first = 0, .count = 0};
  Box halved_a = by_median ? a : halved, halved_b = by_median ? b : halved;
  if (!by_median) halved_a.high[axis] = halved_b.low[axis] = 0.5 * (halved.low[axis] + halved.high[axis]);
  Region region_a = region, region_b = region;
  region_a.high[axis] = std::min(region.high[axis], node.plane[0]);
  region_b.low[axis] = std::max(region.low[axis], node.plane[1]);
  const auto build_a = [&] { node.child[0] = build(first, a, halved_a, region_a, forks_left - 1); };
  const auto build_b = [&] { node.child[1] = build(second, b, halved_b, region_b, forks_left - 1); };
  if (order.size() >= kParallel) {
    tbb::parallel_invoke(build_a, build_b);
  } else {
    build_a();
    build_b();
  }
  return add(node);
}

/// Places the nodes: children of a node side by side; a chunk of levels breadth-first, then one by one the chunks below it.
Bih Builder::laid_out() && {
  if (made_.size() >= BihNode::most) throw std::runtime_error(fmt::format("a bounding interval hierarchy: found {} nodes, expected less than {}", made_.size(), BihNode::most));
  Bih bih{.nodes = {}, .order = {}, .low = grid_.low, .high = grid_.high, .step = grid_.step};
  bih.nodes.reserve(made_.size());
  struct Placed {
    std::uint32_t made, place;
    int depth, forks;
  };
  const auto place = [&](std::vector<Placed>& group, std::uint32_t made, int depth, int forks) {
    group.push_back({made, std::uint32_t(bih.nodes.size()), depth, forks});
    const Made& node = made_[made];
    if (node.children == 0) {
      bih.nodes.push_back({BihNode::leaf_axis | node.first << BihNode::index_shift, node.count});
      ++bih.leaves;
      bih.depth = std::max(bih.depth, depth);
      bih.forks = std::max(bih.forks, forks);
      return;
    }
    const std::uint32_t flag = node.children == 1 ? BihNode::one_child_bit : 0;
    bih.nodes.push_back({std::uint32_t(node.axis) | flag, std::uint32_t(node.plane[0]) | std::uint32_t(node.plane[1]) << 16});
    bih.one_child += node.children == 1;
  };
  std::vector<Placed> chunk, below, waiting;  // `waiting`: nodes in their place whose children have none, the next one last
  place(waiting, root_, 1, 0);
  while (!waiting.empty()) {
    chunk.assign(1, waiting.back());
    waiting.pop_back();
    for (int level = 0; level < config_.chunk_levels && !chunk.empty(); ++level) {
      below.clear();
      for (const Placed& p : chunk) {
        const Made& node = made_[p.made];
        if (node.children > 0) bih.nodes[p.place].link |= std::uint32_t(bih.nodes.size()) << BihNode::index_shift;
        for (int c = 0; c < node.children; ++c) place(below, node.child[std::size_t(c)], p.depth + 1, p.forks + (node.children == 2));
      }
      chunk.swap(below);
    }
    std::copy_if(chunk.rbegin(), chunk.rend(), std::back_inserter(waiting), [&](const Placed& p) { return made_[p.made].children > 0; });
  }
  assert(bih.nodes.size() == made_.size());
  bih.order = std::move(order_);
  return bih;
}

}  // namespace

Bih build_bih(std::span<const BihBox> boxes, const BihConfig& config) {
  assert(config.leaf_size >= 1 && config.chunk_levels >= 1);
  if (boxes.empty()) return {};
  if (boxes.size() >= BihNode::most || levels_to_halve(boxes.size(), config.leaf_size) > config.max_forks)
    throw std::runtime_error(fmt::format("a bounding interval hierarchy: found {} boxes, expected at most {} of a leaf, {} levels above it", boxes.size(),
                                         config.leaf_size, config.max_forks));
  return Builder(boxes, config).laid_out();
}

}  // namespace quincunx

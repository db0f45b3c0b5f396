#include "accel/bih_build.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

namespace quincunx {
namespace {

using Boxes = std::vector<BihBox>;

BihBox cube_at(const glm::vec3& low, float edge = 1.0f) { return {low, low + edge}; }

/// Boxes of any proportions in a box that is not at the origin; flat ones and points among them.
Boxes random_bih_boxes(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-30.0f, 90.0f), size(0.0f, 4.0f);
  Boxes boxes;
  for (int n = 0; n < count; ++n) {
    const glm::vec3 low(place(random), 0.2f * place(random), 5.0f * place(random));
    boxes.push_back({low, low + glm::vec3(n % 3 == 0 ? 0.0f : size(random), n % 4 == 0 ? 0.0f : size(random), n % 5 == 0 ? 0.0f : size(random))});
  }
  return boxes;
}

/// Unit cubes about whole places, those of a shell.
Boxes shell_of_cubes(int edge) {
  Boxes boxes;
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y)
      for (int x = 0; x < edge; ++x)
        if (std::abs(glm::length(glm::vec3(x, y, z) - 0.5f * float(edge)) - 0.4f * float(edge)) < 0.7f) boxes.push_back(cube_at(glm::vec3(x, y, z) - 0.5f));
  return boxes;
}

/// Cubes at 1, 1/3, 1/9 ...: halving the space parts one at a time.
Boxes shrinking(int count) {
  Boxes boxes;
  float at = 1.0f;
  for (int n = 0; n < count; ++n, at /= 3.0f) boxes.push_back(cube_at(glm::vec3(at), 0.1f * at));
  return boxes;
}

struct Case {
  std::string name;
  Boxes boxes;
};
std::vector<Case> cases() {
  return {{"one", {cube_at({3, 4, 5})}},
          {"a point", {cube_at({0, 0, 0}, 0.0f)}},
          {"two", {cube_at({3, 4, 5}), cube_at({-3, 4, 5})}},
          {"random", random_bih_boxes(3000)},
          {"shell", shell_of_cubes(24)},
          {"the same", Boxes(100, cube_at({1, 2, 3}))},
          {"shrinking", shrinking(60)},
          {"far away", {cube_at({1e6f, 0, 0}, 0.25f), cube_at({1e6f, 3, 0}, 0.25f), cube_at({1e6f + 1.0f, 3, 0}, 0.25f)}},
          {"nested", [] {
             Boxes boxes;
             for (int n = 1; n < 50; ++n) boxes.push_back({glm::vec3(-float(n)), glm::vec3(float(n) + 0.3f)});
             return boxes;
           }()}};
}

/// The part of the root's box that planes leave to a node.
struct Region {
  glm::dvec3 low, high;
};
/// The region of a child, from the words of its parent alone.
Region child_region(const Bih& bih, const BihNode& node, int child, Region region) {
  const int a = node.axis();
  const double p = bih.plane_at(a, node.plane(0)), q = bih.plane_at(a, node.plane(1));
  if (node.one_child()) region.low[a] = std::max(region.low[a], p), region.high[a] = std::min(region.high[a], q);
  else if (child == 0) region.high[a] = std::min(region.high[a], p);
  else region.low[a] = std::max(region.low[a], q);
  return region;
}

using Visit = std::function<bool(std::uint32_t, const Region&, int, int)>;  // node, its region, depth, forks above; whether to go below
void visit(const Bih& bih, const Visit& on, std::uint32_t n, const Region& region, int depth, int forks) {
  const BihNode node = bih.nodes.at(n);
  if (!on(n, region, depth, forks) || node.leaf()) return;
  for (int c = 0; c < (node.one_child() ? 1 : 2); ++c)
    visit(bih, on, node.index() + std::uint32_t(c), child_region(bih, node, c, region), depth + 1, forks + !node.one_child());
}
void visit(const Bih& bih, const Visit& on) {
  if (!bih.nodes.empty()) visit(bih, on, 0, {bih.low, bih.high}, 1, 0);
}

bool holds(const Region& region, const BihBox& box) {
  return glm::all(glm::lessThanEqual(region.low, glm::dvec3(box.low))) && glm::all(glm::greaterThanEqual(region.high, glm::dvec3(box.high)));
}

/// Expects every box once, inside what the planes above its leaf have left, and a report that counts what is there.
void expect_tree(const Bih& bih, const Boxes& boxes, const BihConfig& config) {
  std::vector<int> seen(boxes.size()), visits(bih.nodes.size());
  std::uint64_t leaves = 0, one_child = 0, outside = 0, large = 0;
  int depth = 0, forks = 0;
  visit(bih, [&](std::uint32_t n, const Region& region, int d, int f) {
    const BihNode& node = bih.nodes[n];
    ++visits[n];
    one_child += node.one_child();
    if (!node.leaf()) return true;
    ++leaves;
    depth = std::max(depth, d), forks = std::max(forks, f);
    large += node.count() < 1 || node.count() > std::uint32_t(config.leaf_size);
    for (std::uint32_t k = node.index(); k < node.index() + node.count(); ++k) {
      ++seen[bih.order.at(k)];
      outside += !holds(region, boxes[bih.order[k]]);
    }
    return true;
  });
  EXPECT_EQ(outside, 0u);
  EXPECT_EQ(large, 0u);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(boxes.size()));
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), std::ptrdiff_t(bih.nodes.size()));
  EXPECT_EQ(bih.leaves, leaves);
  EXPECT_EQ(bih.one_child, one_child);
  EXPECT_EQ(bih.nodes.size(), boxes.empty() ? 0 : 2 * leaves - 1 + one_child);
  EXPECT_EQ(bih.depth, depth);
  EXPECT_EQ(bih.forks, forks);
  EXPECT_LE(forks, config.max_forks);
  EXPECT_EQ(bih.bytes(), 8 * bih.nodes.size());
}

TEST(BihBuild, EveryBoxIsInOneLeafAndInsideAllPlanesAboveIt) {
  for (const Case& c : cases())
    for (const double trim : {0.0, 1.0 / 1.3, 1.0})
      for (const int leaf_size : {1, 5})
        for (const double least_step : {0.0, 0.5}) {
          SCOPED_TRACE(c.name + ", trim " + std::to_string(trim) + ", leaves of " + std::to_string(leaf_size) + ", steps from " + std::to_string(least_step));
          const BihConfig config{.leaf_size = leaf_size, .trim = trim, .least_step = least_step};
          const Bih bih = build_bih(c.boxes, config);
          expect_tree(bih, c.boxes, config);
          EXPECT_TRUE(trim > 0.0 || bih.one_child == 0);
        }
}

TEST(BihBuild, EveryRayThatMeetsABoxReachesItsLeaf) {
  const Boxes boxes = random_bih_boxes(800);
  const Bih bih = build_bih(boxes, {});
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto meets = [](const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 a = (low - o) / d, b = (high - o) / d, in = glm::min(a, b), out = glm::max(a, b);
    return std::max({in.x, in.y, in.z}) <= std::min({out.x, out.y, out.z});
  };
  std::uint64_t met = 0, missed = 0, looked = 0;
  for (int ray = 0; ray < 400; ++ray) {
    const auto point = [&] { return bih.low + (bih.high - bih.low) * glm::dvec3(uniform(random), uniform(random), uniform(random)); };
    const BihBox& through = boxes[std::size_t(ray) * 2];
    const glm::dvec3 o = point(), d = glm::dvec3(0.5f * (through.low + through.high)) - o;
    std::vector<bool> reached(boxes.size());
    visit(bih, [&](std::uint32_t n, const Region& region, int, int) {
      if (!meets(o, d, region.low, region.high)) return false;
      const BihNode& node = bih.nodes[n];
      for (std::uint32_t k = 0; node.leaf() && k < node.count(); ++k) reached[bih.order[node.index() + k]] = true, ++looked;
      return true;
    });
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      if (!meets(o, d, glm::dvec3(boxes[n].low), glm::dvec3(boxes[n].high))) continue;
      ++met;
      missed += !reached[n];
    }
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_GT(met, 300u);
  EXPECT_LT(looked, 400u * boxes.size() / 4) << "most leaves are passed over";
}

/// Axes, planes and boxes of the tree, parents before children, whatever the order in memory.
std::vector<std::uint32_t> shape_of(const Bih& bih) {
  std::vector<std::uint32_t> words;
  visit(bih, [&](std::uint32_t n, const Region&, int, int) {
    const BihNode& node = bih.nodes[n];
    words.insert(words.end(), {node.link & 7u, node.planes});
    for (std::uint32_t k = 0; node.leaf() && k < node.count(); ++k) words.push_back(bih.order[node.index() + k]);
    return true;
  });
  return words;
}

TEST(BihBuild, IsTheSameTreeInChunksOfAnyDepthAndEveryTime) {
  const Boxes boxes = random_bih_boxes(20000);  // built by several threads
  const std::vector<std::uint32_t> shape = shape_of(build_bih(boxes, {.chunk_levels = 1}));
  for (const int levels : {1, 2, 3, 4, 7, 64}) {
    const BihConfig config{.chunk_levels = levels};
    const Bih bih = build_bih(boxes, config);
    SCOPED_TRACE(levels);
    expect_tree(bih, boxes, config);
    EXPECT_TRUE(shape_of(bih) == shape);
    const Bih again = build_bih(boxes, config);
    EXPECT_TRUE(std::ranges::equal(bih.nodes, again.nodes, [](const BihNode& a, const BihNode& b) { return a.link == b.link && a.planes == b.planes; }));
  }
}

TEST(BihBuild, AChunkIsStoredTogetherAndBreadthFirst) {
  for (const int levels : {1, 2, 4, 64}) {
    const Bih bih = build_bih(shell_of_cubes(24), {.chunk_levels = levels});
    SCOPED_TRACE(levels);
    std::uint64_t chunks = 0, elsewhere = 0;
    visit(bih, [&](std::uint32_t top, const Region&, int depth, int) {
      if (bih.nodes[top].leaf() || (depth - 1) % levels != 0) return true;
      // A chunk is what is below such a node, down to `levels` below it.
      std::uint32_t expected = bih.nodes[top].index();
      std::vector<std::uint32_t> level{top}, below;
      for (int n = 0; n < levels; ++n, level.swap(below), below.clear())
        for (const std::uint32_t parent : level) {
          const BihNode& node = bih.nodes[parent];
          for (int c = 0; c < (node.leaf() ? 0 : node.one_child() ? 1 : 2); ++c, ++expected) {
            elsewhere += node.index() + std::uint32_t(c) != expected;
            below.push_back(node.index() + std::uint32_t(c));
          }
        }
      ++chunks;
      return true;
    });
    EXPECT_EQ(elsewhere, 0u);
    EXPECT_GT(chunks, levels == 64 ? 0u : 10u);
  }
}

TEST(BihBuild, ItsWordsAreThoseOfTheTable) {
  // Two cubes by each other and one far away. The root parts them at x = 8: up to 2, from 15 on. Nothing of the pair is above 1 in y and z.
  const Boxes boxes{cube_at({15, 15, 15}), cube_at({0, 0, 0}), cube_at({1, 0, 0})};
  const Bih bih = build_bih(boxes, {.least_step = 1.0});
  ASSERT_EQ(bih.nodes.size(), 7u);
  const auto words = [&](int n) { return std::pair(bih.nodes[std::size_t(n)].link, bih.nodes[std::size_t(n)].planes); };
  const auto at = [](std::uint32_t low, std::uint32_t high) { return low | high << 16; };
  EXPECT_EQ(words(0), std::pair(0u | 1u << 3, at(2, 15)));       // x: nodes 1 and 2
  EXPECT_EQ(words(1), std::pair(1u | 4u | 3u << 3, at(0, 1)));   // y, one child
  EXPECT_EQ(words(2), std::pair(3u | 2u << 3, 1u));              // the far one
  EXPECT_EQ(words(3), std::pair(2u | 4u | 4u << 3, at(0, 1)));   // z, one child
  EXPECT_EQ(words(4), std::pair(0u | 5u << 3, at(1, 1)));
  EXPECT_EQ(words(5), std::pair(3u | 0u << 3, 1u));
  EXPECT_EQ(words(6), std::pair(3u | 1u << 3, 1u));
  EXPECT_THAT(bih.order, testing::ElementsAre(1, 2, 0));
  EXPECT_EQ(bih.low, glm::dvec3(0.0));
  EXPECT_EQ(bih.high, glm::dvec3(16.0));
  EXPECT_EQ(bih.step, glm::dvec3(1.0));
  EXPECT_EQ(bih.one_child, 2u);
  EXPECT_EQ(bih.depth, 5);
  EXPECT_EQ(bih.forks, 2);
}

TEST(BihBuild, CubesAboutWholePlacesKeepTheirPlanes) {
  const Boxes boxes = shell_of_cubes(24);
  const Bih bih = build_bih(boxes, {.trim = 1.0, .least_step = 0.5});
  EXPECT_EQ(bih.step, glm::dvec3(0.5));
  std::uint64_t elsewhere = 0;
  visit(bih, [&](std::uint32_t, const Region& region, int, int) {
    for (int a = 0; a < 3; ++a)
      elsewhere += std::abs(std::remainder(region.low[a], 1.0)) != 0.5 || std::abs(std::remainder(region.high[a], 1.0)) != 0.5;
    return true;
  });
  EXPECT_EQ(elsewhere, 0u);
}

TEST(BihBuild, WhatWouldGetTooDeepIsPartedAtTheMedian) {
  const Boxes boxes = shrinking(60);
  const Bih free = build_bih(boxes, {.max_forks = 48});
  EXPECT_GT(free.forks, 12);
  for (const int forks : {6, 7, 10, 20}) {
    const BihConfig config{.max_forks = forks};
    const Bih bih = build_bih(boxes, config);
    SCOPED_TRACE(forks);
    expect_tree(bih, boxes, config);
  }
  EXPECT_THROW(build_bih(boxes, {.max_forks = 5}), std::runtime_error);
  EXPECT_EQ(build_bih(boxes, {.leaf_size = 2, .max_forks = 5}).forks, 5);
}

TEST(BihBuild, OverNoBoxesThereAreNoNodes) {
  const Bih bih = build_bih({}, {});
  EXPECT_TRUE(bih.nodes.empty());
  EXPECT_EQ(bih.leaves, 0u);
  EXPECT_EQ(bih.depth, 0);
}

}  // namespace
}  // namespace quincunx

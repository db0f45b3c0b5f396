#include "accel/kdtree.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "accel/kdtree_build.h"
#include "block_masks.h"
#include "tree_walk.h"

namespace quincunx {
namespace {

using glm::dvec3;
using glm::ivec3;

Classification noise(const ivec3& size, double share, unsigned seed) {
  std::mt19937 random(seed);
  return make_mask(size, [&](const ivec3&) { return random() < share * 4294967296.0; });
}

Classification shell(int n, int block = 1) {
  const dvec3 centre(0.5 * n);
  Classification c = make_mask(ivec3(n), [&](const ivec3& b) { return std::abs(glm::length(dvec3(b) + 0.5 - centre) - 0.4 * n) < 0.9; });
  c.block = block;
  return c;
}

/// Three curves through the volume, a block or two thick.
Classification strands(int n) {
  return make_mask(ivec3(n), [&](const ivec3& b) {
    for (int k = 0; k < 3; ++k) {
      const double t = 6.0 * b[k] / n + k;
      const dvec3 offset = dvec3(b) - 0.5 * n;
      if (std::hypot(offset[(k + 1) % 3] - 0.35 * n * std::sin(t), offset[(k + 2) % 3] - 0.3 * n * std::cos(1.7 * t)) < 1.2) return true;
    }
    return false;
  });
}

Classification single(const ivec3& size, const ivec3& where) {
  return make_mask(size, [&](const ivec3& b) { return b == where; });
}

std::map<std::string, Classification> family() {
  std::map<std::string, Classification> all;
  for (int i = 0; i < 6; ++i) all["noise" + std::to_string(i)] = noise({7 + i, 9, 12 - i}, 0.02 * std::pow(2.2, i), unsigned(i));
  all["shell"] = shell(24);
  all["coarse shell"] = shell(17, 4);
  all["strands"] = strands(30);
  all["checkerboard"] = make_mask({9, 8, 7}, [](const ivec3& b) { return (b.x + b.y + b.z) % 2 == 0; });
  all["shell of blocks"] = make_mask({12, 12, 12}, [](const ivec3& b) {
    return glm::any(glm::equal(b, ivec3(0))) || glm::any(glm::equal(b, ivec3(11)));
  });
  for (int corner = 0; corner < 8; ++corner)
    all["corner" + std::to_string(corner)] = single({5, 6, 7}, ivec3(corner & 1, corner >> 1 & 1, corner >> 2) * ivec3(4, 5, 6));
  all["empty"] = noise({6, 5, 4}, 0.0, 0);
  all["full"] = filled_mask({6, 15, 14});
  for (int axis = 0; axis < 3; ++axis) {
    ivec3 row(1);
    row[axis] = 40;
    all["row" + std::to_string(axis)] = noise(row, 0.3, 5);
  }
  return all;
}

/// Boxes of the leaves as the kernels find them: of the list, as many as its parameters say; of the tree, by walking it.
std::vector<BlockBox> leaves_of(const SkippingStructure& structure) {
  const StructureBuffer buffer = structure.buffers().at(0);
  BoxTree tree;
  tree.nodes.resize(buffer.bytes.size() / sizeof(BoxTree::Node));
  std::memcpy(tree.nodes.data(), buffer.bytes.data(), buffer.bytes.size());
  if (structure.shader() == "skip_box_tree.glsl") return walk(tree).leaves;
  std::vector<BlockBox> leaves;
  for (int n = 0; n < structure.parameters().x; ++n) {
    const auto& words = tree.nodes.at(std::size_t(n)).words;
    const auto half = [&](int i) { return int(words[i / 2] >> (i % 2 * 16) & 0xffffu); };
    leaves.push_back({{half(0), half(1), half(2)}, {half(3), half(4), half(5)}});
    EXPECT_EQ(words[3], BoxTree::leaf);
  }
  return leaves;
}

KdTree built(const Classification& c, KdTree::Config config) {
  KdTree tree(config);
  tree.build(c, Thresholds({}, {}));
  return tree;
}

BlockBox brute_trimmed(const Classification& c, const BlockBox& box) {
  BlockBox hull{box.high, box.low};
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int y = box.low.y; y < box.high.y; ++y)
      for (int x = box.low.x; x < box.high.x; ++x)
        if (is_active(c, {x, y, z})) hull = {glm::min(hull.low, {x, y, z}), glm::max(hull.high, ivec3(x, y, z) + 1)};
  return hull.low.x < hull.high.x ? hull : BlockBox{};
}

BlockBox whole(const Classification& c) { return {ivec3(0), ivec3(c.blocks)}; }

bool brute_full(const Classification& c, const BlockBox& box) {
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int y = box.low.y; y < box.high.y; ++y)
      for (int x = box.low.x; x < box.high.x; ++x)
        if (!is_active(c, {x, y, z})) return false;
  return true;
}

const KdTree::Config shallow{.depth = KdDepth::shallow}, deep{}, tiny{.leaf_cells = 1};

class KdTreeOfMask : public testing::TestWithParam<std::pair<const std::string, Classification>> {};
INSTANTIATE_TEST_SUITE_P(Family, KdTreeOfMask, testing::ValuesIn(family()), [](const auto& mask) {
  std::string name = mask.param.first;
  std::erase(name, ' ');
  return name;
});

TEST_P(KdTreeOfMask, LeavesAreTrimmedAndDisjointAndHoldEveryActiveBlock) {
  const Classification& c = GetParam().second;
  for (const KdTree::Config& config : {shallow, deep, tiny}) {
    const KdTree tree = built(c, config);
    std::vector<int> owners(c.level.size(), 0);
    std::int64_t volume = 0;
    for (const BlockBox& leaf : leaves_of(tree)) {
      EXPECT_EQ(leaf, brute_trimmed(c, leaf));
      volume += leaf.volume();
      for (int z = leaf.low.z; z < leaf.high.z; ++z)
        for (int y = leaf.low.y; y < leaf.high.y; ++y)
          for (int x = leaf.low.x; x < leaf.high.x; ++x) ++owners[std::size_t((z * c.blocks.y + y) * c.blocks.x + x)];
    }
    for (std::size_t b = 0; b < owners.size(); ++b) {
      EXPECT_LE(owners[b], 1);
      EXPECT_GE(owners[b], c.level[b] == Classification::active ? 1 : 0);
    }
    EXPECT_LE(volume, brute_trimmed(c, whole(c)).volume());
  }
}

TEST_P(KdTreeOfMask, NoShallowLeafIsSmallerThanATenthAndNoDeepOneLargerThanAllowedUnlessFull) {
  const Classification& c = GetParam().second;
  const double root = double(brute_trimmed(c, whole(c)).volume());
  for (const BlockBox& leaf : leaves_of(built(c, shallow))) EXPECT_GE(double(leaf.volume()), 0.1 * root * (1 - 1e-12));
  for (const int cells : {1, 8, 100, 2048}) {
    for (const BlockBox& leaf : leaves_of(built(c, {.leaf_cells = cells})))
      EXPECT_TRUE(leaf.volume() * c.block * c.block * c.block <= cells || brute_full(c, leaf)) << cells;
  }
}

/// What split_blocks is to do to a box: every plane of every axis, trimmed by looking at every block.
std::pair<BlockBox, BlockBox> brute_split(const Classification& c, const BlockBox& box, std::int64_t least_volume) {
  std::pair<BlockBox, BlockBox> best;
  std::int64_t least = box.volume(), imbalance = std::numeric_limits<std::int64_t>::max();
  for (int axis = 0; axis < 3; ++axis)
    for (int plane = box.low[axis] + 1; plane < box.high[axis]; ++plane) {
      BlockBox low = box, high = box;
      low.high[axis] = high.low[axis] = plane;
      low = brute_trimmed(c, low), high = brute_trimmed(c, high);
      const std::int64_t sum = low.volume() + high.volume(), difference = std::abs(low.volume() - high.volume());
      if (low.volume() < least_volume || high.volume() < least_volume || sum >= box.volume()) continue;
      if (sum < least || (sum == least && difference < imbalance)) least = sum, imbalance = difference, best = {low, high};
    }
  return best;
}

TEST_P(KdTreeOfMask, EveryNodeIsCutByThePlaneThatAnExhaustiveSearchFinds) {
  const Classification& c = GetParam().second;
  const SummedVolume sums(c);
  for (const KdRules& rules : {KdRules{}, KdRules{.least_volume = 20}, KdRules{.leaf_volume = 8, .halve = true, .max_depth = 48}}) {
    const std::vector<BoxNode> nodes = split_blocks(sums, rules);
    ASSERT_EQ(nodes.empty(), c.active_blocks == 0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const BlockBox& box = nodes[n].box;
      EXPECT_TRUE(n > 0 || box == brute_trimmed(c, whole(c)));
      auto expected = brute_split(c, box, rules.least_volume);
      if (rules.halve && expected == std::pair<BlockBox, BlockBox>{}) {
        const ivec3 size = box.size();
        const int axis = int(std::max_element(&size.x, &size.x + 3) - &size.x);
        BlockBox low = box, high = box;
        low.high[axis] = high.low[axis] = box.low[axis] + size[axis] / 2;
        expected = {brute_trimmed(c, low), brute_trimmed(c, high)};
      }
      if (box.volume() <= rules.leaf_volume || brute_full(c, box)) expected = {};
      if (expected == std::pair<BlockBox, BlockBox>{}) {
        EXPECT_THAT(nodes[n].child, testing::Each(-1)) << n;
        continue;
      }
      ASSERT_THAT(nodes[n].child, testing::Each(testing::AllOf(testing::Gt(int(n)), testing::Lt(int(nodes.size()))))) << n;
      EXPECT_EQ(nodes[std::size_t(nodes[n].child[0])].box, expected.first) << n;
      EXPECT_EQ(nodes[std::size_t(nodes[n].child[1])].box, expected.second) << n;
    }
  }
}

TEST_P(KdTreeOfMask, TheReportCountsLeavesNodesAndLevels) {
  const Classification& c = GetParam().second;
  for (const KdTree::Config& config : {shallow, deep, tiny}) {
    const KdTree tree = built(c, config);
    const StructureReport report = tree.report();
    EXPECT_EQ(report.leaves, leaves_of(tree).size());
    EXPECT_EQ(std::uint64_t(tree.parameters().x), report.leaves);
    EXPECT_EQ(report.nodes, report.leaves == 0 ? 0 : 2 * report.leaves - 1);
    EXPECT_GE(std::pow(2.0, report.depth), double(report.leaves));
    EXPECT_LE(report.depth, int(report.leaves));
    EXPECT_EQ(report.leaves == 0, c.active_blocks == 0);
    EXPECT_FALSE(tree.buffers().at(0).bytes.empty());
    EXPECT_EQ(tree.buffers().at(0).name, "boxes");
  }
}

/// Where the ray is inside, entry < exit if anywhere for more than a point.
std::pair<double, double> interval(const dvec3& eye, const dvec3& direction, const BlockBox& box, int block) {
  double entry = 0.0, exit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.low[axis] * block - eye[axis]) / direction[axis], b = (box.high[axis] * block - eye[axis]) / direction[axis];
    entry = std::max(entry, std::min(a, b)), exit = std::min(exit, std::max(a, b));
  }
  return {entry, exit};
}

TEST_P(KdTreeOfMask, RaysMeetTheLeavesOfAnArrangedListFrontToBack) {
  const Classification& c = GetParam().second;
  KdTree tree = built(c, {.depth = KdDepth::shallow, .least_share = 0.01});
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit;
  const dvec3 size = dvec3(c.blocks) * double(c.block);
  for (int e = 0; e < 60; ++e) {
    const double distance = std::vector{0.3, 1.0, 100.0}[std::size_t(e % 3)];  // inside, about the surface, far
    dvec3 eye = 0.5 * size + distance * size * dvec3(normal(random), normal(random), normal(random));
    if (e % 5 == 0) eye = glm::floor(eye);  // on planes
    tree.arrange(eye);
    const std::vector<BlockBox> leaves = leaves_of(tree);
    for (int r = 0; r < 35; ++r) {
      const dvec3 target = size * dvec3(unit(random), unit(random), unit(random));
      double met = 0.0;
      for (const BlockBox& leaf : leaves) {
        const auto [entry, exit] = interval(eye, target - eye, leaf, c.block);
        if (exit - entry <= 1e-9) continue;
        EXPECT_GE(entry, met - 1e-9) << "eye " << e << " ray " << r;
        met = exit;  // disjoint boxes: the next one begins where this one ends or later
      }
    }
  }
}

TEST(KdTree, ArrangingChangesTheVersionOfAListIfAndOnlyIfTheOrderChanges) {
  KdTree tree = built(strands(20), shallow);
  ASSERT_GE(tree.report().leaves, 2u);
  std::uint64_t version = tree.buffers()[0].version;
  int changes = 0;
  std::mt19937 random(3);
  std::normal_distribution<double> normal(10.0, 20.0);
  for (int e = 0; e < 200; ++e) {
    const std::vector<BlockBox> before = leaves_of(tree);
    const dvec3 eye(normal(random), normal(random), normal(random));
    tree.arrange(eye);
    const bool changed = leaves_of(tree) != before;
    changes += changed;
    EXPECT_EQ(tree.buffers()[0].version != version, changed);
    version = tree.buffers()[0].version;
    tree.arrange(eye);
    EXPECT_EQ(tree.buffers()[0].version, version);
  }
  EXPECT_GT(changes, 10);
}

TEST(KdTree, ArrangingLeavesADeepTreeAsItIs) {
  KdTree tree = built(strands(20), tiny);
  const auto version = tree.buffers()[0].version;
  const auto before = leaves_of(tree);
  tree.arrange({100.0, -3.0, 7.0});
  EXPECT_EQ(tree.buffers()[0].version, version);
  EXPECT_EQ(leaves_of(tree), before);
}

TEST(KdTree, BuildingAgainReplacesLeavesAndVersion) {
  for (const KdTree::Config& config : {shallow, deep}) {
    KdTree tree = built(strands(30), config);
    for (const Classification& c : {shell(12), noise({4, 4, 4}, 0.0, 0), single({3, 4, 5}, {2, 3, 4}), strands(30)}) {
      const auto version = tree.buffers()[0].version;
      tree.build(c, Thresholds({}, {}));
      tree.arrange({-5.0, 3.0, 2.0});
      KdTree fresh = built(c, config);
      fresh.arrange({-5.0, 3.0, 2.0});
      EXPECT_NE(tree.buffers()[0].version, version);
      EXPECT_EQ(leaves_of(tree), leaves_of(fresh));
      EXPECT_EQ(tree.parameters(), fresh.parameters());
    }
  }
}

TEST(KdTree, ASplitThatSavesNothingYetOpensABoxOfWallsInDeepTreesOnly) {
  // Walls around a hollow cube: every plane's two sides fill their halves of the box. Halved once, the parts have corners to cut.
  const Classification c = make_mask(ivec3(16), [](const ivec3& b) {
    return glm::any(glm::equal(b, ivec3(0))) || glm::any(glm::equal(b, ivec3(15)));
  });
  EXPECT_EQ(leaves_of(built(c, shallow)).size(), 1u);
  std::int64_t volume = 0;
  for (const BlockBox& leaf : leaves_of(built(c, tiny))) volume += leaf.volume();
  EXPECT_EQ(volume, 16 * 16 * 16 - 14 * 14 * 14);
}

TEST(KdTree, AChainDeeperThanTheKernelsStackIsHalvedInTime) {
  // Active blocks with gaps that grow along x: the best plane always lies in the last gap and cuts off one block.
  std::vector<bool> chain(4096);
  for (std::size_t gap = 0, x = 0; x < chain.size(); x += ++gap) chain[x] = true;
  const Classification c = make_mask({4096, 1, 1}, [&](const ivec3& b) { return chain[std::size_t(b.x)]; });
  const auto depth = [&](int limit) {
    const auto nodes = split_blocks(SummedVolume(c), {.leaf_volume = 1, .halve = true, .max_depth = limit});
    std::vector<int> below(nodes.size(), 0);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int child : nodes[n].child)
        if (child >= 0) below[std::size_t(child)] = below[n] + 1;
    return *std::max_element(below.begin(), below.end());
  };
  EXPECT_EQ(depth(1000), int(c.active_blocks) - 2);  // the first two are neighbours: a full box
  for (const int limit : {12, 13, 20, 48}) EXPECT_LE(depth(limit), limit);
  const KdTree tree = built(c, tiny);
  EXPECT_LE(tree.report().depth, BoxTree::max_depth + 1);
  EXPECT_EQ(tree.report().leaves, c.active_blocks - 1);
}

TEST(KdTree, TheTreeIsTheSameWhateverTheNumberOfThreads) {
  const Classification c = shell(64);
  const KdTree parallel = built(c, deep);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const KdTree alone = built(c, deep);
  const auto bytes = [](const KdTree& tree) {
    const auto b = tree.buffers()[0].bytes;
    return std::vector<std::byte>(b.begin(), b.end());
  };
  EXPECT_EQ(bytes(parallel), bytes(alone));
}

}  // namespace
}  // namespace quincunx

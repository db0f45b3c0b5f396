#include "accel/box_tree.h"

#include <gmock/gmock.h>

#include <cstring>

#include "tree_walk.h"

namespace quincunx {
namespace {

using testing::ElementsAre;

constexpr BlockBox cell(int x, int y, int z) { return {{x, y, z}, {x + 1, y + 1, z + 1}}; }

/// A chain of `depth` levels below the root: on each a leaf and the rest.
std::vector<BoxNode> chain(int depth) {
  std::vector<BoxNode> nodes = {{{{0, 0, 0}, {depth + 1, 1, 1}}}};
  for (int level = 0; level < depth; ++level) {
    const std::int32_t leaf = std::int32_t(nodes.size());
    nodes.back().child[0] = leaf;
    nodes.back().child[1] = leaf + 1;
    nodes.push_back({cell(level, 0, 0)});
    nodes.push_back({{{level + 1, 0, 0}, {depth + 1, 1, 1}}});
  }
  return nodes;
}

TEST(BoxTree, PacksTheCornersAndTheNumberOfTheChildrenIntoFourWords) {
  std::vector<BoxNode> nodes(5);
  nodes[0] = {{{1, 2, 3}, {9, 10, 11}}, {3, 1}};
  nodes[1] = {{{0x1234, 0x2345, 0x3456}, {0xffff, 0xfedc, 0xabcd}}, {4, 2}};
  nodes[2] = {{{0x1234, 0x2345, 0x3456}, {0x1235, 0x2346, 0x3457}}, {-1, -1}};
  nodes[3] = {{{1, 2, 3}, {4, 5, 6}}, {-1, -1}};
  nodes[4] = {{{0x1240, 0x2345, 0x3456}, {0xffff, 0xfedc, 0xabcd}}, {-1, -1}};
  const BoxTree tree = flatten(nodes);
  ASSERT_EQ(tree.nodes.size(), 4u);
  EXPECT_THAT(tree.nodes[0].words, ElementsAre(0x00020001u, 0x00040003u, 0x00060005u, BoxTree::leaf));
  EXPECT_THAT(tree.nodes[1].words, ElementsAre(0x23451234u, 0xffff3456u, 0xabcdfedcu, 2u));
  EXPECT_THAT(tree.nodes[2].words, ElementsAre(0x23451240u, 0xffff3456u, 0xabcdfedcu, BoxTree::leaf));
  EXPECT_THAT(tree.nodes[3].words, ElementsAre(0x23451234u, 0x12353456u, 0x34572346u, BoxTree::leaf));
  EXPECT_EQ(tree.leaves, 3u);
  EXPECT_EQ(tree.depth, 2);
}

TEST(BoxTree, ADepthCountsTheNodesFromTheRootToTheDeepestLeaf) {
  EXPECT_EQ(depth_of({}), 0);
  EXPECT_EQ(depth_of(chain(0)), 1);
  EXPECT_EQ(depth_of(chain(5)), 6);
}

TEST(BoxTree, WithoutNodesItIsTwoLeavesThatAreNotThere) {
  const BoxTree tree = flatten({});
  ASSERT_EQ(tree.nodes.size(), 2u);
  for (const BoxTree::Node& node : tree.nodes)
    EXPECT_THAT(node.words, ElementsAre(0x00010001u, 0x00000001u, 0u, BoxTree::leaf));  // low 1, high 0
  EXPECT_EQ(tree.leaves, 0u);
  EXPECT_EQ(tree.depth, 0);
}

TEST(BoxTree, OfOneLeafHasThatAsOneChildOfTheRoot) {
  const BoxTree tree = flatten({{cell(4, 5, 6)}});
  const TreeWalk found = walk(tree);
  EXPECT_THAT(found.leaves, ElementsAre(cell(4, 5, 6)));
  EXPECT_EQ(tree.nodes.size(), 2u);
  EXPECT_EQ(tree.leaves, 1u);
  EXPECT_EQ(tree.depth, 1);
}

TEST(BoxTree, AnOnlyChildGetsASiblingThatIsNotThere) {
  std::vector<BoxNode> nodes(3);
  nodes[0] = {{{0, 0, 0}, {5, 5, 5}}, {1, -1}};
  nodes[1] = {cell(1, 2, 3), {-1, 2}};
  nodes[2] = {cell(1, 2, 3), {-1, -1}};
  const BoxTree tree = flatten(nodes);
  const TreeWalk found = walk(tree);
  EXPECT_THAT(found.leaves, ElementsAre(cell(1, 2, 3)));
  EXPECT_EQ(tree.nodes.size(), 4u);
  EXPECT_EQ(tree.leaves, 1u);
  EXPECT_EQ(tree.depth, 2);
  EXPECT_EQ(found.depth, 2);
}

TEST(BoxTree, ComesLevelByLevel) {
  // The left child of the root has two leaves, the right one two inner nodes with two leaves each.
  std::vector<BoxNode> nodes(11);
  const auto inner = [&](int n, int first, int second) { nodes[std::size_t(n)] = {{{0, 0, 0}, {9, 9, 9}}, {first, second}}; };
  for (int n = 0; n < 11; ++n) nodes[std::size_t(n)].box = cell(n, 0, 0);
  inner(0, 1, 4), inner(1, 2, 3), inner(4, 5, 8), inner(5, 6, 7), inner(8, 9, 10);
  std::vector<int> first_x, children;
  for (const BoxTree::Node& node : flatten(nodes).nodes) {
    first_x.push_back(int(node.words[0] & 0xffff));
    children.push_back(int(node.words[3]));
  }
  EXPECT_THAT(children, ElementsAre(2, 4, -1, -1, 6, 8, -1, -1, -1, -1));
  EXPECT_THAT(first_x, ElementsAre(0, 0, 2, 3, 0, 0, 6, 7, 9, 10));
}

TEST(BoxTree, GoesAsDeepAsTheStackOfTheKernelAndNoDeeper) {
  const BoxTree deepest = flatten(chain(BoxTree::max_depth));
  EXPECT_EQ(deepest.depth, BoxTree::max_depth);
  EXPECT_EQ(deepest.leaves, std::uint64_t(BoxTree::max_depth) + 1);
  const TreeWalk found = walk(deepest);
  EXPECT_EQ(found.depth, BoxTree::max_depth);
  EXPECT_EQ(found.leaves.size(), deepest.leaves);
  EXPECT_THROW(flatten(chain(BoxTree::max_depth + 1)), std::runtime_error);
}

TEST(BoxTree, RefusesBoxesThatSixteenBitsDoNotHold) {
  EXPECT_NO_THROW(flatten({{{{65534, 0, 0}, {65535, 1, 1}}}}));
  for (int axis = 0; axis < 3; ++axis) {
    BlockBox box = cell(0, 0, 0);
    box.high[axis] = 65536;
    EXPECT_THROW(flatten({{box}}), std::runtime_error);
  }
}

TEST(BoxTree, HandsItsNodesOutAsOneBuffer) {
  const BoxTree tree = flatten(chain(3));
  const StructureBuffer buffer = buffer_of(tree, 17);
  EXPECT_EQ(buffer.name, "boxes");
  EXPECT_EQ(buffer.format, TexelFormat::rgba32);
  EXPECT_EQ(buffer.version, 17u);
  ASSERT_EQ(buffer.bytes.size(), tree.nodes.size() * 16);
  EXPECT_EQ(std::memcmp(buffer.bytes.data(), tree.nodes.data(), buffer.bytes.size()), 0);
}

}  // namespace
}  // namespace quincunx

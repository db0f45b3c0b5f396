#include "accel/bricks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "lattice/error.h"
#include "spline/spline.h"

namespace quincunx {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

/// Noise, padded as Coefficients are: every number of the border differs, to see which are read.
Coefficients<double> noise(LatticeKind lattice, const Extents& extents, int apron) {
  Coefficients<double> c{lattice, extents, apron, {}, {}, {}};
  std::mt19937 random(7);
  for (std::int64_t n = 0; n < coset_count(lattice) * c.stride_coset(); ++n) c.data.push_back(double(random() % 4096));
  return c;
}

/// The slot of a brick as coefficients of their own, written by their numbers in the whole volume.
Coefficients<double> slot_of(const BrickLayout& layout, const glm::ivec3& brick, const Coefficients<double>& whole) {
  Coefficients<double> slot{layout.lattice, Extents(layout.samples - 2 * layout.apron), layout.apron, {}, {}, {}};
  slot.data.assign(std::size_t(layout.slot_floats()), std::numeric_limits<double>::quiet_NaN());
  const glm::i64vec3 last = whole.extents + std::int64_t(whole.apron - 1);
  const glm::i64vec3 strides(layout.strides()), first = layout.first_index(brick);
  for (int c = 0; c < coset_count(layout.lattice); ++c)
    for (std::int64_t k = first.z; k < first.z + layout.samples; ++k)
      for (std::int64_t j = first.y; j < first.y + layout.samples; ++j)
        for (std::int64_t i = first.x; i < first.x + layout.samples; ++i)
          slot.data.at(std::size_t(layout.origin(brick, 0) + c * strides.z + i + j * strides.x + k * strides.y)) =
              whole.data[whole.number(c, glm::min(glm::i64vec3(i, j, k), last))];
  return slot;
}

TEST(BrickLayout, ASlotHoldsAllThatTheSplineReachesFromTheCellsOfItsBrick) {
  std::mt19937 random(5);
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    const LatticeKind lattice = spline->lattice();
    const Extents extents = lattice == LatticeKind::bcc ? Extents(9, 5, 6) : Extents(17, 9, 12);
    const Coefficients<double> whole = noise(lattice, extents, spline->apron());
    const BrickLayout layout(lattice, extents, spline->apron(), 4);
    const glm::dvec3 last(domain_max(lattice, extents));
    std::set<std::int32_t> met;
    for (int n = 0; n < 4000; ++n) {
      glm::dvec3 u;  // sixteenths, many of them whole: exact in the brick's own coordinates
      for (int a = 0; a < 3; ++a) u[a] = random() % 3 == 0 ? double(random() % int(last[a])) : double(random() % int(16 * last[a])) / 16;
      const glm::ivec3 brick = layout.brick_of_cell(glm::ivec3(u));
      met.insert(layout.number(brick));
      const Jet expected = spline->evaluate(whole, u);
      const Jet found = spline->evaluate(slot_of(layout, brick, whole), u - glm::dvec3(brick * layout.edge));
      ASSERT_EQ(found.value, expected.value) << name << " at " << u.x << ", " << u.y << ", " << u.z;
      ASSERT_EQ(found.gradient, expected.gradient);
    }
    EXPECT_EQ(std::int64_t(met.size()), layout.count()) << name;
  }
}

TEST(BrickLayout, CountsBricksOverCellsAndSamplesPerSlot) {
  const BrickLayout bcc(LatticeKind::bcc, {17, 16, 1}, 1, 32);  // 33, 31 and 1 cells
  EXPECT_EQ(bcc.bricks, glm::ivec3(2, 1, 1));
  EXPECT_EQ(bcc.samples, 16 + 3);
  EXPECT_EQ(bcc.slot_floats(), 2 * 19 * 19 * 19);
  const BrickLayout cartesian(LatticeKind::cartesian, {34, 33, 1}, 0, 32);  // 33, 32 and 1 cells
  EXPECT_EQ(cartesian.bricks, glm::ivec3(2, 1, 1));
  EXPECT_EQ(cartesian.samples, 33);
  EXPECT_EQ(cartesian.slot_floats(), 33 * 33 * 33);
}

TEST(BrickLayout, NumbersBricksAndTheirOriginsApart) {
  const BrickLayout layout(LatticeKind::bcc, {20, 15, 12}, 1, 8);
  ASSERT_EQ(layout.bricks, glm::ivec3(5, 4, 3));
  for (std::int32_t n = 0; n < layout.count(); ++n) {
    EXPECT_EQ(layout.number(layout.brick(n)), n);
    const glm::i64vec3 first = layout.first_index(layout.brick(n)), strides(layout.strides());
    EXPECT_EQ(first, glm::i64vec3(layout.brick(n) * 4 - 1));
    for (const int slot : {0, 1, 59})
      EXPECT_EQ(layout.origin(layout.brick(n), slot) + first.x + first.y * strides.x + first.z * strides.y, slot * layout.slot_floats());
  }
  EXPECT_EQ(layout.brick_of_cell({7, 8, 23}), glm::ivec3(0, 1, 2));
}

TEST(BrickLayout, RefusesEdgesAndVolumesThatCannotBeNumbered) {
  for (const int edge : {-4, 0, 2, 3, 5, 48, 512})
    EXPECT_THAT(refusal([&] { BrickLayout(LatticeKind::bcc, {9, 9, 9}, 1, edge); }), HasSubstr("--brick: found " + std::to_string(edge)));
  EXPECT_THAT(refusal([] { BrickLayout(LatticeKind::cartesian, Extents(65536), 1, 4); }), HasSubstr("16384 x 16384 x 16384 bricks"));
  // The last brick's origin would be 65280 planes of 259^2 coefficients before its slot.
  EXPECT_THAT(refusal([] { BrickLayout(LatticeKind::cartesian, {9, 9, 65536}, 1, 256); }), HasSubstr("--brick: found 256, too large"));
  EXPECT_NO_THROW(BrickLayout(LatticeKind::cartesian, {9, 9, 65536}, 1, 128));
  EXPECT_NO_THROW(BrickLayout(LatticeKind::cartesian, {65536, 65536, 1}, 1, 32));
}

TEST(BrickLayout, APoolHasAsManySlotsAsFitIt) {
  const BrickLayout layout(LatticeKind::cartesian, {33, 17, 17}, 0, 16);
  ASSERT_EQ(layout.count(), 2);
  const std::uint64_t slot = 17 * 17 * 17 * 4;
  EXPECT_EQ(layout.slot_bytes(), slot);
  EXPECT_EQ(layout.slots(slot), 1);
  EXPECT_EQ(layout.slots(2 * slot - 1), 1);
  EXPECT_EQ(layout.slots(100 * slot), 2);
  EXPECT_THAT(refusal([&] { layout.slots(0); }), HasSubstr("--pool: found 0 bytes, expected at least 19652 bytes"));
  EXPECT_THAT(refusal([&] { layout.slots(slot - 1); }), HasSubstr("--pool: found 19651 bytes"));
}

TEST(BrickLayout, APoolLargerThanNumbersReachIsRefusedAndTheLargestOnesOriginsFit) {
  const BrickLayout layout(LatticeKind::cartesian, Extents(2000), 1, 64);
  EXPECT_THAT(refusal([&] { layout.slots(std::uint64_t(1) << 34); }), HasSubstr("--pool: found 17179869184 bytes, expected at most"));
  const int most = layout.slots(std::uint64_t(std::numeric_limits<std::int32_t>::max()) * 4);
  EXPECT_LE(most * layout.slot_floats(), std::numeric_limits<std::int32_t>::max());
  EXPECT_GT(layout.origin({0, 0, 0}, most - 1), 0);
  EXPECT_LT(layout.origin(layout.bricks - 1, 0), 0);
  EXPECT_NE(layout.origin(layout.bricks - 1, 0), std::numeric_limits<std::int32_t>::min());
}

/// The bricks that the ray from `eye` through `through` meets, in order, from many points along it.
std::vector<std::int32_t> bricks_along(const BrickLayout& layout, const glm::dvec3& eye, const glm::dvec3& through) {
  std::vector<std::int32_t> met;
  const glm::ivec3 cells(domain_max(layout.lattice, layout.extents));
  for (int n = 0; n < 3000; ++n) {
    const glm::dvec3 u = eye + double(n) / 1000.0 * (through - eye);
    if (glm::any(glm::lessThan(u, glm::dvec3(0.0))) || glm::any(glm::greaterThanEqual(u, glm::dvec3(cells)))) continue;
    const std::int32_t brick = layout.number(layout.brick_of_cell(glm::ivec3(u)));
    if (met.empty() || met.back() != brick) met.push_back(brick);
  }
  return met;
}

TEST(BrickOrder, NoRayMeetsABrickBeforeOneInFrontOfIt) {
  const BrickLayout layout(LatticeKind::bcc, {20, 15, 12}, 1, 8);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-60.0, 100.0), inside(0.0, 1.0);
  std::size_t pairs = 0;
  for (int n = 0; n < 300; ++n) {
    glm::dvec3 eye(anywhere(random), anywhere(random), anywhere(random));
    if (n % 3 == 0) eye = glm::dvec3(39, 29, 23) * glm::dvec3(inside(random), inside(random), inside(random));
    std::vector<std::int32_t> order(std::size_t(layout.count()));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    sort_front_to_back(layout, eye, order);
    std::vector<std::int32_t> rank(order.size());
    for (std::size_t r = 0; r < order.size(); ++r) rank[std::size_t(order[r])] = std::int32_t(r);
    const glm::dvec3 through = glm::dvec3(39, 29, 23) * glm::dvec3(inside(random), inside(random), inside(random));
    const std::vector<std::int32_t> met = bricks_along(layout, eye, through);
    for (std::size_t m = 1; m < met.size(); ++m, ++pairs) EXPECT_LT(rank[std::size_t(met[m - 1])], rank[std::size_t(met[m])]);
  }
  EXPECT_GT(pairs, 600u);
}

TEST(BrickOrder, BeginsWithTheBrickNearestToTheEyeAndBreaksTiesByNumber) {
  const BrickLayout layout(LatticeKind::cartesian, {9, 9, 1}, 0, 4);  // 2 x 2 bricks
  EXPECT_EQ(eye_brick(layout, {-5, 100, 3}), glm::ivec3(0, 1, 0));
  EXPECT_EQ(eye_brick(layout, {4, 3.99, 0}), glm::ivec3(1, 0, 0));
  EXPECT_EQ(eye_brick(layout, {1e300, -1e300, 0}), glm::ivec3(1, 0, 0));
  std::vector<std::int32_t> bricks{3, 1, 2, 0};
  sort_front_to_back(layout, {-5, 100, 3}, bricks);
  EXPECT_THAT(bricks, ElementsAre(2, 0, 3, 1));
}

TEST(ActiveBricks, AreThoseThatShareACellWithAnActiveBlock) {
  std::mt19937 random(11);
  const Extents extents(14, 9, 11);
  const glm::ivec3 cells(domain_max(LatticeKind::bcc, extents));
  for (const int block : {1, 2, 8, 16})
    for (const int edge : {4, 8}) {
      const BrickLayout layout(LatticeKind::bcc, extents, 1, edge);
      Classification blocks;
      blocks.block = block;
      blocks.blocks = (glm::i64vec3(cells) + std::int64_t(block - 1)) / std::int64_t(block);
      for (std::int64_t n = 0; n < blocks.blocks.x * blocks.blocks.y * blocks.blocks.z; ++n)
        blocks.level.push_back(int(random() % 2000) < std::min(block * block * block, 700) ? Classification::active
                                                                                           : std::uint8_t(random() % 3));
      std::vector<std::uint8_t> expected(std::size_t(layout.count()), 0);
      for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
          for (int x = 0; x < cells.x; ++x) {
            const glm::i64vec3 b = glm::i64vec3(x, y, z) / std::int64_t(block);
            if (blocks.level[std::size_t((b.z * blocks.blocks.y + b.y) * blocks.blocks.x + b.x)] == Classification::active)
              expected[std::size_t(layout.number({x / edge, y / edge, z / edge}))] = 1;
          }
      EXPECT_EQ(active_bricks(layout, blocks), expected) << block << " in " << edge;
      EXPECT_GT(std::count(expected.begin(), expected.end(), 0), 0);
      EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 0);
    }
}

}  // namespace
}  // namespace quincunx

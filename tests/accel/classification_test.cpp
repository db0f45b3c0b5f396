#include "accel/classification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coefficient_sets.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// The level of one interval by the definition.
std::uint8_t level_of(double min, double max, const std::vector<double>& isovalues) {
  std::uint8_t level = 0;
  for (double iso : isovalues) {
    if (min <= iso && iso <= max) return Classification::active;
    level = std::uint8_t(level + (iso < min));
  }
  return level;
}

/// `count` isovalues over the range of the bounds and a little beyond, ascending.
std::vector<double> isovalues_across(const CellBounds& cells, int count) {
  std::vector<double> isovalues;
  const double range = cells.value(65535) - cells.low;
  for (int n = 0; n < count; ++n) isovalues.push_back(cells.low + range * (1.2 * (n + 0.5) / count - 0.1));
  return isovalues;
}

void expect_levels(const CellBounds& cells, int block, const std::vector<double>& isovalues) {
  const BlockBounds bounds = block_bounds(cells, block);
  const Classification c = classify(bounds, cells, ranges_of(isovalues));
  EXPECT_EQ(c.block, block);
  EXPECT_EQ(c.blocks, bounds.blocks);
  ASSERT_EQ(c.level.size(), bounds.min.size());
  for (std::size_t n = 0; n < c.level.size(); ++n)
    ASSERT_EQ(c.level[n], level_of(cells.value(bounds.min[n]), cells.value(bounds.max[n]), isovalues)) << n;
  EXPECT_EQ(c.active_blocks, std::size_t(std::count(c.level.begin(), c.level.end(), Classification::active)));
}

TEST(Classification, GivesEveryBlockTheLevelOfTheDefinition) {
  const CellBounds cells = bounds_of(smooth_coefficients({19, 18, 17}));
  for (int block : {1, 2, 8, 64})
    for (int count : {0, 1, 2, 5, 30, 254}) expect_levels(cells, block, isovalues_across(cells, count));
}

TEST(Classification, OfSmallAndHugeNumbersAndConstantsIsThatOfTheDefinition) {
  for (const CoefficientSet& set : coefficient_sets()) {
    const CellBounds cells = bounds_of(set.c);
    for (int count : {1, 7}) expect_levels(cells, 2, isovalues_across(cells, count));
  }
}

TEST(Classification, AnIsovalueEqualToAnEndOfAnIntervalTouchesItAndTheNextNumberBeyondDoesNot) {
  const CellBounds cells = bounds_of(smooth_coefficients({9, 9, 9}));
  const BlockBounds bounds = block_bounds(cells, 4);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < bounds.min.size(); n += 7) {
    const double min = cells.value(bounds.min[n]), max = cells.value(bounds.max[n]);
    const auto level = [&](double iso) { return classify(bounds, cells, ranges_of(std::vector{iso})).level[n]; };
    EXPECT_EQ(level(min), Classification::active);
    EXPECT_EQ(level(max), Classification::active);
    EXPECT_EQ(level(std::nextafter(min, -kInfinity)), 1) << "the isovalue is below the block";
    EXPECT_EQ(level(std::nextafter(max, kInfinity)), 0) << "the isovalue is above the block";
  }
}

TEST(Classification, OfMoreThan254IsovaluesIsRefused) {
  const CellBounds cells = bounds_of(smooth_coefficients({2, 2, 2}));
  const BlockBounds blocks = block_bounds(cells, 1);
  EXPECT_NO_THROW(classify(blocks, cells, ranges_of(isovalues_across(cells, 254))));
  try {
    classify(blocks, cells, ranges_of(isovalues_across(cells, 255)));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "--iso: found 255 isovalues, expected at most 254");
  }
}

}  // namespace
}  // namespace quincunx

#include <gtest/gtest.h>

#include "accel/classification.h"
#include "coefficient_sets.h"

namespace quincunx {
namespace {

bool bit(const CellOccupancy& o, const glm::i64vec3& cell) {
  const glm::i64vec3 b = cell / std::int64_t(4), r = cell % std::int64_t(4);
  return o.words[std::size_t((b.z * o.bricks.y + b.y) * o.bricks.x + b.x)] >> (r.z * 16 + r.y * 4 + r.x) & 1;
}

/// The definition, for the cell (x,y,z), which may lie outside the volume.
bool touches(const CellBounds& cells, const glm::i64vec3& cell, const std::vector<double>& isovalues) {
  if (glm::any(glm::greaterThanEqual(cell, cells.cells))) return false;
  const std::size_t n = cells.number(cell);
  for (double iso : isovalues)
    if (cells.value(cells.min[n]) <= iso && iso <= cells.value(cells.max[n])) return true;
  return false;
}

void expect_occupancy(const CellBounds& cells, const std::vector<double>& isovalues) {
  const CellOccupancy o = occupancy(cells, ranges_of(isovalues));
  ASSERT_EQ(o.bricks, (cells.cells + std::int64_t(3)) / std::int64_t(4));
  ASSERT_EQ(std::int64_t(o.words.size()), o.bricks.x * o.bricks.y * o.bricks.z);
  std::size_t active = 0;
  for (std::int64_t z = 0; z < 4 * o.bricks.z; ++z)
    for (std::int64_t y = 0; y < 4 * o.bricks.y; ++y)
      for (std::int64_t x = 0; x < 4 * o.bricks.x; ++x) {
        const bool expected = touches(cells, {x, y, z}, isovalues);
        ASSERT_EQ(bit(o, {x, y, z}), expected) << x << ' ' << y << ' ' << z;
        active += expected;
      }
  EXPECT_EQ(o.active_cells, active);
}

TEST(Occupancy, HasTheBitsOfTheCellsThatTouchAnIsovalueAndNoneOutside) {
  const CellBounds cells = bounds_of(smooth_coefficients({19, 10, 8}));
  const double range = cells.value(65535) - cells.low;
  for (int count : {0, 1, 3, 8, 9, 40}) {  // few are compared one by one, many looked up
    std::vector<double> isovalues;
    for (int n = 0; n < count; ++n) isovalues.push_back(cells.low + range * (n + 0.5) / count);
    expect_occupancy(cells, isovalues);
  }
}

TEST(Occupancy, TouchesAtEqualityAndAtNoNumberBeyondTheRange) {
  for (const CoefficientSet& set : coefficient_sets()) {
    const CellBounds cells = bounds_of(set.c);
    const std::size_t n = cells.min.size() / 2;
    expect_occupancy(cells, {cells.value(cells.min[n])});
    expect_occupancy(cells, {cells.value(cells.max[n])});
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(occupancy(cells, ranges_of(std::vector{std::nextafter(cells.low, -kInfinity)})).active_cells, 0u);
    EXPECT_EQ(occupancy(cells, ranges_of(std::vector{std::nextafter(cells.value(65535), kInfinity)})).active_cells, 0u);
  }
}

}  // namespace
}  // namespace quincunx

#include "accel/range_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "accel/classification.h"

namespace quincunx {
namespace {

using Row = std::vector<std::uint8_t>;

constexpr RangeQueryKind kKinds[] = {RangeQueryKind::intervals, RangeQueryKind::table, RangeQueryKind::irt};

bool any_of(const Row& set, std::size_t first, std::size_t last) {
  return std::any_of(set.begin() + std::ptrdiff_t(first), set.begin() + std::ptrdiff_t(last) + 1, [](std::uint8_t s) { return s != 0; });
}

TEST(RangeQuery, OfEveryKindAnswersAllQuestionsToAllShortRows) {
  for (std::size_t size = 1; size <= 10; ++size)
    for (unsigned mask = 0; mask < 1u << size; ++mask) {
      Row set(size);
      for (std::size_t n = 0; n < size; ++n) set[n] = (mask >> n & 1) ? std::uint8_t(1 + 17 * n) : 0;
      for (const RangeQueryKind kind : kKinds)
        with_range_query(kind, set, [&](const auto& query) {
          for (std::size_t first = 0; first < size; ++first)
            for (std::size_t last = first; last < size; ++last)
              ASSERT_EQ(query.any(first, last), any_of(set, first, last)) << int(kind) << " " << size << " " << mask << " " << first << " " << last;
        });
    }
}

TEST(RangeQuery, OfEveryKindAnswersAlikeOnLongRows) {
  std::mt19937 random(11);
  for (const std::size_t size : {63u, 64u, 65u, 255u, 256u, 1000u, 4096u, 8192u})
    for (const unsigned rarity : {2u, 30u, 3000u}) {
      Row set(size);
      for (std::uint8_t& s : set) s = random() % rarity == 0;
      for (const RangeQueryKind kind : kKinds)
        with_range_query(kind, set, [&](const auto& query) {
          for (int n = 0; n < 500; ++n) {
            const std::size_t first = random() % size, last = n % 5 == 0 ? size - 1 : std::min(size - 1, first + random() % (n % 2 == 0 ? 70 : size));
            ASSERT_EQ(query.any(first, last), any_of(set, first, last)) << int(kind) << " " << size << " " << first << " " << last;
          }
        });
    }
}

TEST(RangeQuery, TakesTheMemoryThatItsKindNeeds) {
  const Row set(1000);
  EXPECT_EQ(IntervalQuery(set).bytes(), 4000u);
  EXPECT_EQ(TableQuery(set).bytes(), 1000u * 16u * 8u);
  EXPECT_EQ(TreeQuery(set).bytes(), 2000u);
}

/// A few ranges of values from below a scale to above it, some of a single value, some closer to each other than its numbers.
std::vector<ValueRange> random_ranges(std::mt19937& random, const ValueScale& scale) {
  std::vector<ValueRange> ranges;
  std::uniform_real_distribution<double> number(-5000.0, 70000.0), width(0.0, 1.0);
  for (unsigned n = random() % 6; n-- > 0;) {
    const double low = number(random), w = width(random);
    ranges.push_back({scale.low + scale.step * low, scale.low + scale.step * (low + (n % 3 == 0 ? 0.0 : 3000.0 * w * w * w * w))});
  }
  return merged(ranges);
}

TEST(RangeTest, ByEntriesHoldsAllThatIsVisibleAndLittleMore) {
  std::mt19937 random(2);
  int near = 0, far = 0;
  for (int round = 0; round < 300; ++round) {
    const ValueScale scale{.low = -3.0, .step = 0.37};
    const std::vector<ValueRange> ranges = random_ranges(random, scale);
    const Thresholds thresholds(scale, ranges);
    with_range_test(RangeQueryKind::table, thresholds, [&](const auto& by_table) {
      with_range_test(RangeQueryKind::irt, thresholds, [&](const auto& by_tree) {
        with_range_test(RangeQueryKind::intervals, thresholds, [&](const auto& exact) {
          for (int n = 0; n < 300; ++n) {
            const auto min = std::uint16_t(random()), max = std::uint16_t(std::min(65535u, min + unsigned(random() % (n % 2 == 0 ? 20 : 3000))));
            const bool visible = std::ranges::any_of(
                ranges, [&](const ValueRange& r) { return scale.value(min) <= r.high && r.low <= scale.value(max); });
            const bool reachable = thresholds.touches(std::uint16_t(std::max(0, min - kNumbersOfAnEntry)),
                                                      std::uint16_t(std::min(65535, max + kNumbersOfAnEntry)));
            ASSERT_EQ(exact(min, max), visible);
            ASSERT_EQ(by_table(min, max), by_tree(min, max));
            ASSERT_TRUE(by_table(min, max) || !visible) << min << " " << max;
            ASSERT_TRUE(!by_table(min, max) || reachable) << min << " " << max;
            near += by_table(min, max) && !visible;
            far += !by_table(min, max);
          }
        });
      });
    });
  }
  EXPECT_GT(near, 0) << "an entry holds more than its numbers";
  EXPECT_GT(far, 10000);
}

/// Bounds of 5 x 6 x 7 cells, made up.
CellBounds random_bounds(std::mt19937& random) {
  CellBounds bounds;
  bounds.low = -1.0;
  bounds.step = 1.0 / 1024.0;
  bounds.cells = {5, 6, 7};
  for (int n = 0; n < 5 * 6 * 7; ++n) {
    bounds.min.push_back(std::uint16_t(random()));
    bounds.max.push_back(std::uint16_t(std::min(65535u, bounds.min.back() + unsigned(random() % 2000))));
  }
  return bounds;
}

TEST(RangeTest, MakesBlocksAndCellsActiveInTheSameWay) {
  std::mt19937 random(4);
  for (int round = 0; round < 100; ++round) {
    const CellBounds cells = random_bounds(random);
    const BlockBounds blocks = block_bounds(cells, 2);
    const std::vector<ValueRange> ranges = random_ranges(random, cells);
    const Thresholds thresholds(cells, ranges);
    for (const RangeQueryKind kind : kKinds) {
      const Classification c = classify(blocks, cells, ranges, kind);
      const CellOccupancy o = occupancy(cells, ranges, kind);
      with_range_test(kind, thresholds, [&](const auto& touches) {
        std::size_t active = 0;
        for (std::size_t n = 0; n < blocks.min.size(); ++n) {
          ASSERT_EQ(c.level[n], touches(blocks.min[n], blocks.max[n]) ? Classification::active : thresholds.below(blocks.min[n]));
          active += c.level[n] == Classification::active;
        }
        EXPECT_EQ(c.active_blocks, active);
        active = 0;
        for (std::int64_t z = 0; z < 7; ++z)
          for (std::int64_t y = 0; y < 6; ++y)
            for (std::int64_t x = 0; x < 5; ++x) {
              const std::uint64_t word = o.words[std::size_t((z / 4 * o.bricks.y + y / 4) * o.bricks.x + x / 4)];
              const bool set = word >> (z % 4 * 16 + y % 4 * 4 + x % 4) & 1;
              const std::size_t n = cells.number({x, y, z});
              ASSERT_EQ(set, touches(cells.min[n], cells.max[n])) << int(kind) << " " << n;
              active += set;
            }
        EXPECT_EQ(o.active_cells, active);
      });
    }
  }
}

}  // namespace
}  // namespace quincunx

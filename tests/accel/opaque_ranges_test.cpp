#include "accel/opaque_ranges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace quincunx {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kLargest = std::numeric_limits<double>::max();

/// A table of `entries`, each of which goes on as its neighbour three times in four.
std::vector<float> random_table(std::mt19937& random, int entries) {
  std::vector<float> alpha;
  bool opaque = random() % 2 == 0;
  for (int n = 0; n < entries; ++n) {
    if (random() % 4 == 0) opaque = !opaque;
    alpha.push_back(opaque ? float(random() % 1000 + 1) / 1000.0f : 0.0f);
  }
  return alpha;
}

/// The look-up as a kernel does it.
float look_up(const std::vector<float>& alpha, float low, float high, float value) {
  const float last = float(alpha.size() - 1), scale = last / (high - low);
  const float x = std::clamp((value - low) * scale, 0.0f, last);
  const auto n = std::min(std::size_t(x), alpha.size() - 2);
  return alpha[n] + (x - float(n)) * (alpha[n + 1] - alpha[n]);
}

TEST(OpaqueRanges, ReachToTheEntriesWithoutOpacityAndALittleFurther) {
  constexpr double m = 1.0 / 64.0;
  EXPECT_THAT(opaque_ranges(std::vector{0.0f, 0.0f, 0.0f}, 0.0, 2.0), IsEmpty());
  EXPECT_THAT(opaque_ranges(std::vector{0.0f, 0.0f, 1.0f, 0.0f, 0.0f}, 0.0, 4.0), ElementsAre(ValueRange{1.0 - m, 3.0 + m}));
  EXPECT_THAT(opaque_ranges(std::vector{0.0f, 0.0f, 1.0f, 0.0f, 0.0f}, 10.0, 18.0), ElementsAre(ValueRange{12.0 - 2 * m, 16.0 + 2 * m}));
  EXPECT_THAT(opaque_ranges(std::vector{1.0f, 0.0f, 0.0f, 1.0f}, 0.0, 3.0), ElementsAre(ValueRange{-kLargest, 1.0 + m}, ValueRange{2.0 - m, kLargest}));
  EXPECT_THAT(opaque_ranges(std::vector{0.5f, 1.0f}, 0.0, 1.0), ElementsAre(ValueRange{-kLargest, kLargest}));
  // One clear entry is a value without width, two are a stretch.
  EXPECT_THAT(opaque_ranges(std::vector{0.0f, 1.0f, 0.0f, 1.0f, 0.0f}, 0.0, 4.0), ElementsAre(ValueRange{-m, 4.0 + m}));
  EXPECT_THAT(opaque_ranges(std::vector{0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f}, 0.0, 5.0),
              ElementsAre(ValueRange{-m, 2.0 + m}, ValueRange{3.0 - m, 5.0 + m}));
}

TEST(OpaqueRanges, HoldEveryValueForWhichALookUpInFloatsFindsOpacity) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const int entries = round % 2 == 0 ? 8192 : 2 + int(random() % 40);
    const float low = std::ldexp(float(random() % 2001) - 1000.0f, int(random() % 9) - 4), high = low + std::ldexp(1.0f + float(random() % 100), int(random() % 9) - 4);
    const std::vector<float> alpha = random_table(random, entries);
    const std::vector<ValueRange> ranges = opaque_ranges(alpha, low, high);
    for (std::size_t n = 1; n < ranges.size(); ++n) EXPECT_LT(ranges[n - 1].high, ranges[n].low);
    std::uniform_real_distribution<float> inside(low - 0.1f * (high - low), high + 0.1f * (high - low));
    int clear = 0;
    for (int n = 0; n < 2000; ++n) {
      float value = inside(random);
      if (n % 2 == 0) {  // around an entry
        value = low + (high - low) * float(random() % unsigned(entries)) / float(entries - 1);
        value = std::nextafter(value, n % 4 == 0 ? low : high);
      }
      const bool held = std::ranges::any_of(ranges, [&](const ValueRange& r) { return r.low <= double(value) && double(value) <= r.high; });
      ASSERT_TRUE(held || look_up(alpha, low, high, value) == 0.0f) << value << " round " << round;
      clear += !held;
    }
    if (entries == 8192) {
      EXPECT_GT(clear, 100) << "ranges that hold all values hold the right ones too";
    }
  }
}

TEST(JoinedRanges, KeepTheWidestGaps) {
  const std::vector<ValueRange> ranges{{0, 1}, {2, 3}, {3.5, 3.5}, {9, 10}, {10.25, 11}};
  EXPECT_EQ(joined(ranges, 5), ranges);
  EXPECT_EQ(joined(ranges, 254), ranges);
  EXPECT_THAT(joined(ranges, 4), ElementsAre(ranges[0], ranges[1], ranges[2], ValueRange{9, 11}));
  EXPECT_THAT(joined(ranges, 3), ElementsAre(ranges[0], ValueRange{2, 3.5}, ValueRange{9, 11}));
  EXPECT_THAT(joined(ranges, 2), ElementsAre(ValueRange{0, 3.5}, ValueRange{9, 11}));
  EXPECT_THAT(joined(ranges, 1), ElementsAre(ValueRange{0, 11}));
  EXPECT_THAT(joined({}, 1), IsEmpty());
}

}  // namespace
}  // namespace quincunx

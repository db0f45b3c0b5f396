#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "lattice/volume.h"

namespace quincunx {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

template <class T>
Volume line_of(std::vector<T> samples) {
  return {LatticeKind::cartesian, {std::int64_t(samples.size()), 1, 1}, {}, std::move(samples), {}};
}

TEST(SampleRange, CoversTheExtremesOfEveryType) {
  const auto expect = [](const Volume& volume, double min, double max) {
    const SampleRange range = sample_range(volume);
    EXPECT_EQ(range.min, min);
    EXPECT_EQ(range.max, max);
    EXPECT_EQ(range.not_finite, 0u);
  };
  expect(line_of<std::uint8_t>({3, 255, 0}), 0, 255);
  expect(line_of<std::int16_t>({3, -32768, 32767}), -32768, 32767);
  expect(line_of<std::uint16_t>({3, 65535, 7}), 3, 65535);
  expect(line_of<float>({-0.5f, -3.5f, -2.0f}), -3.5, -0.5);
  expect(line_of<float>({std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max()}),
         std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max());
}

TEST(SampleRange, CountsWhatIsNotFiniteAndNamesTheFirst) {
  const SampleRange range = sample_range(line_of<float>({1.0f, 2.0f, inf, nan, 0.5f, -inf}));
  EXPECT_EQ(range.min, 0.5);
  EXPECT_EQ(range.max, 2.0);
  EXPECT_EQ(range.not_finite, 3u);
  EXPECT_EQ(range.first_not_finite, 2u);
}

TEST(SampleRange, IsZeroWhereNothingIsFinite) {
  const SampleRange range = sample_range(line_of<float>({nan, inf}));
  EXPECT_EQ(range.min, 0.0);
  EXPECT_EQ(range.max, 0.0);
  EXPECT_EQ(range.not_finite, 2u);
  EXPECT_EQ(range.first_not_finite, 0u);
}

TEST(SampleRange, FindsExtremesAndTheFirstNotFiniteInAnyPartOfALargeVolume) {
  std::vector<float> samples(300'000, 1.0f);  // several blocks of the parallel reduction
  samples[70'001] = -4.0f;
  samples[299'999] = 9.0f;
  samples[150'000] = samples[200'000] = nan;
  const SampleRange range = sample_range(line_of(samples));
  EXPECT_EQ(range.min, -4.0);
  EXPECT_EQ(range.max, 9.0);
  EXPECT_EQ(range.not_finite, 2u);
  EXPECT_EQ(range.first_not_finite, 150'000u);
}

const std::vector<double> fractions{0.0, 0.01, 0.25, 0.5, 0.77, 0.99, 1.0};

template <class T>
void expect_quantiles_of_the_sorted(std::vector<T> samples) {
  std::vector<T> sorted = samples;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<double> quantiles = sample_quantiles(line_of(std::move(samples)), fractions);
  ASSERT_EQ(quantiles.size(), fractions.size());
  for (std::size_t f = 0; f < fractions.size(); ++f) {
    const auto rank = std::size_t(std::lround(fractions[f] * double(sorted.size() - 1)));
    EXPECT_EQ(quantiles[f], double(sorted[rank])) << "at " << fractions[f];
  }
}

TEST(SampleQuantiles, AreOrderStatisticsOfEveryType) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> bytes(1001);
  std::vector<std::int16_t> shorts(1000);
  std::vector<std::uint16_t> words(998);
  std::vector<float> floats(997);
  for (auto& s : bytes) s = std::uint8_t(random());
  for (auto& s : shorts) s = std::int16_t(random());
  for (auto& s : words) s = std::uint16_t(random());
  for (auto& s : floats) s = float(random()) - 2e9f;
  expect_quantiles_of_the_sorted(bytes);
  expect_quantiles_of_the_sorted(shorts);
  expect_quantiles_of_the_sorted(words);
  expect_quantiles_of_the_sorted(floats);
  expect_quantiles_of_the_sorted(std::vector<std::int16_t>{-32768});
  expect_quantiles_of_the_sorted(std::vector<std::int16_t>{32767, -32768});
}

TEST(SampleQuantiles, LeaveOutWhatIsNotFinite) {
  const std::vector<double> quantiles =
      sample_quantiles(line_of<float>({nan, 3.0f, inf, 1.0f, -inf, 2.0f}), {{0.0, 0.5, 1.0}});
  EXPECT_THAT(quantiles, testing::ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(sample_quantiles(line_of<float>({nan, inf}), {{0.5}}), testing::ElementsAre(0.0));
}

}  // namespace
}  // namespace quincunx

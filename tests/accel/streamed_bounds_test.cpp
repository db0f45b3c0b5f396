#include "accel/streamed_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <random>
#include <vector>

#include "lattice/error.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

/// Smooth waves with some noise, 0..255, and nothing beyond x = 100.
Volume waves(LatticeKind lattice, const Extents& extents) {
  Volume v{lattice, extents, {}, std::vector<std::uint8_t>{}, {}};
  std::mt19937 random(6);
  for (int c = 0; c < coset_count(lattice); ++c)
    for (std::int64_t k = 0; k < extents.z; ++k)
      for (std::int64_t j = 0; j < extents.y; ++j)
        for (std::int64_t i = 0; i < extents.x; ++i) {
          const double wave = std::sin(0.11 * double(i)) * std::cos(0.2 * double(j) + 0.3 * double(k));
          const double sample = i > 100 ? 7.0 : 120.0 + 100.0 * wave + double(random() % 30);
          std::get<std::vector<std::uint8_t>>(v.samples).push_back(std::uint8_t(sample));
        }
  return v;
}

/// More than one box along x and y, none divided by blocks; and axes of one sample.
std::vector<Extents> extents_of(LatticeKind lattice) {
  if (lattice == LatticeKind::bcc) return {{263, 38, 3}, {9, 1, 35}, {1, 1, 1}};
  return {{525, 70, 5}, {17, 1, 67}, {1, 1, 1}};
}

/// Calls check(spline, prefilter, volume) for all of them.
template <class Check>
void for_each_case(const Check& check) {
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    for (const Extents& extents : extents_of(spline->lattice()))
      for (const Spline::Filter& filter : spline->filters()) {
        SCOPED_TRACE(std::string(name) + ", " + std::string(prefilter_name(filter.kind)) + ", " + std::to_string(extents.x) + " samples along x");
        check(*spline, filter.kind, waves(spline->lattice(), extents));
      }
  }
}

TEST(StreamedBounds, HoldTheSplineAtRandomPoints) {
  for_each_case([](const Spline& spline, Spline::Prefilter prefilter, const Volume& volume) {
    const StreamedBounds bounds = streamed_bounds(VolumeSource(volume), spline, prefilter, 4, "volume");
    const Coefficients<double> c = spline.coefficients(volume, prefilter);
    const glm::dvec3 last(domain_max(volume.lattice, volume.extents));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int n = 0; n < 10'000; ++n) {
      const glm::dvec3 u = last * glm::dvec3(uniform(random), uniform(random), uniform(random));
      const double value = spline.evaluate(c, u).value;
      const glm::i64vec3 b = glm::i64vec3(cell_of(u, glm::i64vec3(last))) / std::int64_t(4);
      const std::size_t number = std::size_t((b.z * bounds.blocks.blocks.y + b.y) * bounds.blocks.blocks.x + b.x);
      ASSERT_LE(bounds.scale.value(bounds.blocks.min[number]), value);
      ASSERT_GE(bounds.scale.value(bounds.blocks.max[number]), value);
    }
  });
}

TEST(StreamedBounds, AreThoseOfTheWholeVolumeAndLittleWider) {
  for_each_case([](const Spline& spline, Spline::Prefilter prefilter, const Volume& volume) {
    const CellBounds cells = cell_bounds(spline, spline.coefficients_float(volume, prefilter));
    for (const int block : {1, 2, 8, 64, 128}) {
      const BlockBounds expected = block_bounds(cells, block);
      const StreamedBounds found = streamed_bounds(VolumeSource(volume), spline, prefilter, block, "volume");
      ASSERT_EQ(found.blocks.block, block);
      ASSERT_EQ(found.blocks.blocks, expected.blocks);
      const double wider = 4.0 * found.scale.step;
      for (std::size_t n = 0; n < expected.min.size(); ++n) {
        const double low = found.scale.value(found.blocks.min[n]), high = found.scale.value(found.blocks.max[n]);
        ASSERT_LE(low, cells.value(expected.min[n]) + cells.step);
        ASSERT_GE(low, cells.value(expected.min[n]) - wider) << "block " << n << " of " << block;
        ASSERT_GE(high, cells.value(expected.max[n]) - cells.step);
        ASSERT_LE(high, cells.value(expected.max[n]) + wider) << "block " << n << " of " << block;
      }
    }
  });
}

TEST(StreamedBounds, SayTheRangeOfTheSamplesAndTheScaleOfTheWholeVolume) {
  const auto spline = make_spline("bcc7");
  const Volume volume = waves(LatticeKind::bcc, {140, 40, 3});
  const StreamedBounds bounds = streamed_bounds(VolumeSource(volume), *spline, Spline::Prefilter::automatic, 8, "volume");
  const SampleRange samples = sample_range(volume);
  EXPECT_EQ(bounds.samples.min, samples.min);
  EXPECT_EQ(bounds.samples.max, samples.max);
  const BoundsScale scale = bounds_scale(*spline, Spline::Prefilter::automatic, samples.min, samples.max, cell_count(volume.lattice, volume.extents));
  EXPECT_EQ(bounds.scale.low, scale.low);
  EXPECT_EQ(bounds.scale.step, scale.step);
  EXPECT_EQ(bounds.scale.displacement, scale.displacement);
}

/// Notes the largest box that is read.
class WatchedSource final : public SampleSource {
 public:
  explicit WatchedSource(const Volume& volume) : source_(volume) {}
  const Volume& header() const override { return source_.header(); }
  Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const override {
    Volume box = source_.read_box(low, high);
    const std::lock_guard lock(mutex_);
    largest = std::max(largest, box.sample_count());
    return box;
  }
  mutable std::size_t largest = 0;

 private:
  VolumeSource source_;
  mutable std::mutex mutex_;
};

TEST(StreamedBounds, ReadTheSamplesInBoxesOfBoundedSize) {
  const Volume volume{LatticeKind::cartesian, {700, 100, 70}, {}, std::vector<std::uint8_t>(4'900'000), {}};
  const WatchedSource source(volume);
  std::vector<double> fractions;
  streamed_bounds(source, *make_spline("tricubic"), Spline::Prefilter::automatic, 256, "volume",
                  [&](double fraction) { fractions.push_back(fraction); });
  EXPECT_LE(source.largest, std::size_t(521 * 73 * 73));  // 512 x 64 x 64 cells and 2 around, with corners, apron and the prefilter's reach
  EXPECT_GE(fractions.size(), 8u);
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(StreamedBounds, RefuseSamplesThatAreNotFiniteAndBlocksThatAreNone) {
  Volume volume{LatticeKind::bcc, {4, 3, 2}, {}, std::vector<float>(48, 1.0f), {}};
  const auto error = [&](int block) -> std::string {
    try {
      streamed_bounds(VolumeSource(volume), *make_spline("bcc7"), Spline::Prefilter::none, block, "v.nrrd");
    } catch (const InputError& refused) {
      return refused.what();
    }
    return "(no error)";
  };
  EXPECT_EQ(error(2), "(no error)");
  EXPECT_THAT(error(3), HasSubstr("--block: found 3"));
  std::get<std::vector<float>>(volume.samples)[24 + 12 + 4 + 1] = std::numeric_limits<float>::quiet_NaN();
  std::get<std::vector<float>>(volume.samples)[47] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(error(2), "v.nrrd: found 2 NaN or infinite of 48 samples, the first at coset 1, index (1, 1, 1); expected finite samples");
}

TEST(StreamedBounds, LetAnInterruptThroughInBothPasses) {
  const Volume volume = waves(LatticeKind::cartesian, {20, 20, 20});
  for (const double from : {0.0, 0.5})
    EXPECT_THROW(streamed_bounds(VolumeSource(volume), *make_spline("trilinear"), Spline::Prefilter::none, 8, "volume",
                                 [&](double fraction) {
                                   if (fraction >= from) throw Interrupted();
                                 }),
                 Interrupted);
}

}  // namespace
}  // namespace quincunx

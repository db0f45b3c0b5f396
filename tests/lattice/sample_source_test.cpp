#include "lattice/sample_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// Samples that all differ: their number times 3, and 7.
template <class T>
Volume numbered(LatticeKind lattice, const Extents& extents) {
  Volume v{lattice, extents, {}, std::vector<T>{}, {{"content", "numbers"}}};
  v.world.origin = {1, 2, 3};
  v.world.axes = glm::dmat3(0.5, 0, 0, 0.25, 1, 0, 0, 0, 2);
  auto& samples = std::get<std::vector<T>>(v.samples);
  for (std::size_t n = 0; n < v.sample_count(); ++n) samples.push_back(T(3 * n + 7));
  return v;
}

TEST(VolumeSource, ABoxHoldsTheSamplesOfEveryCosetInTheirPlaceInTheWorld) {
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc}) {
    const Volume whole = numbered<std::int16_t>(lattice, {5, 4, 3});
    const VolumeSource source(whole);
    const glm::i64vec3 low(1, 0, 2), high(4, 3, 3);
    const Volume box = source.read_box(low, high);
    EXPECT_NO_THROW(check_volume(box, "box"));
    EXPECT_EQ(box.lattice, lattice);
    EXPECT_EQ(box.type(), SampleType::int16);
    EXPECT_EQ(box.extents, high - low);
    EXPECT_EQ(box.world.axes, whole.world.axes);
    EXPECT_EQ(box.world.origin, whole.world.to_world(glm::dvec3(low * std::int64_t(lattice_step(lattice)))));
    for (int coset = 0; coset < coset_count(lattice); ++coset)
      for (std::int64_t j = 0; j < 3; ++j)
        for (std::int64_t i = 0; i < 3; ++i)
          EXPECT_EQ(box.sample(coset, {i, j, 0}), whole.sample(coset, low + glm::i64vec3(i, j, 0)));
  }
}

TEST(VolumeSource, TheHeaderSaysEverythingButTheSamples) {
  const Volume whole = numbered<std::uint16_t>(LatticeKind::bcc, {2, 3, 4});
  const VolumeSource source(whole);
  EXPECT_EQ(source.header().lattice, whole.lattice);
  EXPECT_EQ(source.header().extents, whole.extents);
  EXPECT_EQ(source.header().world.origin, whole.world.origin);
  EXPECT_EQ(source.header().notes, whole.notes);
  EXPECT_EQ(source.header().type(), SampleType::uint16);
  EXPECT_EQ(source.header().sample_count(), whole.sample_count());
}

TEST(StreamedSampleRange, IsThatOfTheVolumeOverManyBoxesAndCountsWhatIsNotFinite) {
  // A plane of 700 rows is read as 512 rows of 2048 samples, 2^20, and the rest. Both cosets.
  Volume whole = numbered<float>(LatticeKind::bcc, {2048, 700, 2});
  auto& samples = std::get<std::vector<float>>(whole.samples);
  const VolumeSource source(whole);
  std::vector<double> fractions;
  SampleRange range = sample_range(source, [&](double fraction) { fractions.push_back(fraction); });
  EXPECT_EQ(range.min, 7.0);
  EXPECT_EQ(range.max, double(float(3 * samples.size() + 4)));
  EXPECT_EQ(range.not_finite, 0u);
  EXPECT_EQ(range.first_not_finite, 0u);
  EXPECT_GE(fractions.size(), 2u);
  EXPECT_EQ(fractions.back(), 1.0);

  // The first box holds the first one in its second coset; a later box holds one of the first coset, with a lower number.
  const std::size_t row = 2048, plane = 700 * row, first = plane + 600 * row + 9;
  samples[2 * plane + 5] = kNotANumber;
  samples[first] = -std::numeric_limits<float>::infinity();
  samples[3 * plane + 699 * row] = kNotANumber;
  range = sample_range(source);
  const SampleRange expected = sample_range(whole);
  EXPECT_EQ(range.min, expected.min);
  EXPECT_EQ(range.max, expected.max);
  EXPECT_EQ(range.not_finite, 3u);
  EXPECT_EQ(range.first_not_finite, first);
}

TEST(StreamedSampleRange, OfNothingFiniteIsZero) {
  const Volume whole{LatticeKind::cartesian, {2, 1, 1}, {}, std::vector<float>{kNotANumber, kNotANumber}, {}};
  const SampleRange range = sample_range(VolumeSource(whole));
  EXPECT_EQ(range.min, 0.0);
  EXPECT_EQ(range.max, 0.0);
  EXPECT_EQ(range.not_finite, 2u);
}

TEST(StreamedSampleRange, LetsAnInterruptThrough) {
  const Volume whole = numbered<std::uint8_t>(LatticeKind::cartesian, {3, 3, 3});
  const VolumeSource source(whole);
  EXPECT_THROW(sample_range(source, [](double) { throw Interrupted(); }), Interrupted);
}

}  // namespace
}  // namespace quincunx

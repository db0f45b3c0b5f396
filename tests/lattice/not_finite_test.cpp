#include "lattice/not_finite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

namespace quincunx {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

using Field = std::function<double(const glm::dvec3&)>;

/// Float samples f(u), u in lattice coordinates.
Volume volume_of(LatticeKind lattice, const Extents& n, const Field& f) {
  Volume volume;
  volume.lattice = lattice;
  volume.extents = n;
  const int step = lattice_step(lattice);
  std::vector<float> samples;
  for (int c = 0; c < coset_count(lattice); ++c)
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) samples.push_back(float(f(glm::dvec3(step * i + c, step * j + c, step * k + c))));
  volume.samples = std::move(samples);
  return volume;
}

std::vector<float>& samples_of(Volume& volume) { return std::get<std::vector<float>>(volume.samples); }

TEST(NotFinite, BecomesTheValueThatFillsItAndNothingElseChanges) {
  Volume volume = volume_of(LatticeKind::cartesian, {6, 1, 1}, [](const glm::dvec3& u) { return u.x; });
  samples_of(volume)[1] = kNan, samples_of(volume)[3] = kInf, samples_of(volume)[4] = -kInf;
  fill_not_finite(volume, -2.5);
  EXPECT_EQ(samples_of(volume), (std::vector<float>{0.0f, -2.5f, 2.0f, -2.5f, -2.5f, 5.0f}));
}

TEST(NotFinite, IsFilledInBoxesAsInTheWhole) {
  Volume volume = volume_of(LatticeKind::bcc, {4, 3, 5}, [](const glm::dvec3& u) { return u.x + u.y * u.z; });
  samples_of(volume)[17] = kNan, samples_of(volume)[80] = kInf;
  const auto source = filled_source(std::make_shared<VolumeSource>(volume), 7.0);
  Volume filled = volume;
  fill_not_finite(filled, 7.0);
  EXPECT_EQ(source->read_box({0, 0, 0}, {4, 3, 5}).samples, filled.samples);
  EXPECT_EQ(source->read_box({1, 0, 1}, {3, 3, 4}).samples, VolumeSource(filled).read_box({1, 0, 1}, {3, 3, 4}).samples);
}

TEST(NotFinite, IsNothingThatIntegersCanBe) {
  Volume volume{LatticeKind::cartesian, {2, 1, 1}, {}, std::vector<std::uint8_t>{3, 255}, {}};
  const Volume before = volume;
  EXPECT_FALSE(may_not_be_finite(volume));
  fill_not_finite(volume, 0.0);
  extend_finite(volume);
  EXPECT_EQ(volume.samples, before.samples);
  const auto source = std::make_shared<VolumeSource>(volume);
  EXPECT_EQ(filled_source(source, 0.0), source) << "nothing stands before what needs no filling";
}

TEST(NotFinite, IsExtendedAsALinearFunctionBesideFiniteSamples) {
  // Balls, planes and corners of gaps: whatever stands beside two finite samples in a row is exact, up to rounding.
  const Field linear = [](const glm::dvec3& u) { return 3.0 - 0.5 * u.x + 0.25 * u.y + 2.0 * u.z; };
  for (const LatticeKind lattice : {LatticeKind::bcc, LatticeKind::cartesian}) {
    const double size = 13.0;
    const std::vector<Field> gaps{[](const glm::dvec3& u) { return 4.0 - glm::length(u - glm::dvec3(6, 7, 6)); },
                                  [](const glm::dvec3& u) { return 1.1 - std::abs(u.y - 6.0); }, [&](const glm::dvec3& u) { return u.x + u.y + u.z - 2.4 * size; },
                                  [](const glm::dvec3& u) { return 0.5 - glm::length(u - glm::dvec3(6)); }};
    for (const Field& gap : gaps) {
      const Extents n = lattice == LatticeKind::bcc ? Extents{7, 7, 7} : Extents{14, 14, 14};
      Volume volume = volume_of(lattice, n, [&](const glm::dvec3& u) { return gap(u) > 0.0 ? (u.x < 6.5 ? kNan : -kInf) : linear(u); });
      const Volume truth = volume_of(lattice, n, linear), holed = volume;
      ASSERT_GT(sample_range(volume).not_finite, 0u);
      extend_finite(volume);
      EXPECT_EQ(sample_range(volume).not_finite, 0u);
      std::size_t exact = 0;
      const auto &before = std::get<std::vector<float>>(holed.samples), &expected = std::get<std::vector<float>>(truth.samples);
      const SampleRange range = sample_range(holed);
      for (std::size_t s = 0; s < before.size(); ++s) {
        const float after = samples_of(volume)[s];
        if (std::isfinite(before[s])) {
          EXPECT_EQ(std::memcmp(&after, &before[s], sizeof after), 0);
        } else if (after != float(0.5 * range.min + 0.5 * range.max)) {  // the middle of a gap
          EXPECT_NEAR(after, expected[s], 1e-4);
          ++exact;
        }
      }
      EXPECT_GT(exact, 0u);
    }
  }
}

TEST(NotFinite, IsTheMeanOfNeighboursWithoutOthersBehindThemAndZeroWhereNothingIsFinite) {
  Volume line = volume_of(LatticeKind::cartesian, {5, 1, 1}, [](const glm::dvec3& u) { return u.x == 1.0 ? 4.0 : kNan; });
  extend_finite(line);
  EXPECT_EQ(samples_of(line), (std::vector<float>{4.0f, 4.0f, 4.0f, 4.0f, 4.0f}));
  Volume nothing = volume_of(LatticeKind::bcc, {2, 2, 2}, [](const glm::dvec3&) { return kInf; });
  extend_finite(nothing);
  EXPECT_EQ(samples_of(nothing), std::vector<float>(16, 0.0f));
}

TEST(NotFinite, StaysWithinTheLargestFloats) {
  Volume line = volume_of(LatticeKind::cartesian, {3, 1, 1}, [](const glm::dvec3& u) { return u.x == 0.0 ? kNan : u.x == 1.0 ? 3e38 : -3e38; });
  extend_finite(line);
  EXPECT_EQ(samples_of(line)[0], std::numeric_limits<float>::max());
}

}  // namespace
}  // namespace quincunx

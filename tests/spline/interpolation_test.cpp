// Prefilter::iir: B-splines that take the samples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "spline/interpolation.h"
#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

constexpr auto kIir = Spline::Prefilter::iir;

/// A B-spline: what the neighbours of a sample weigh there, of 1, and its pole.
struct Interpolating {
  std::string_view name;
  double side;
  InterpolationMask mask;
};
const Interpolating kSplines[] = {{"triquadratic", 1.0 / 8.0, kQuadraticInterpolation}, {"tricubic", 1.0 / 6.0, kCubicInterpolation}};

TEST(Interpolation, TakesEverySampleButThoseAtTheBorder) {
  const Extents extents(41, 7, 64);
  const Volume volume = random_volume(LatticeKind::cartesian, extents, 1);
  for (const Interpolating& s : kSplines) {
    const auto spline = make_spline(s.name);
    const auto c = spline->coefficients(volume, kIir);
    double inside = 0.0, border = 0.0;
    for (std::int64_t k = 0; k < extents.z; ++k)
      for (std::int64_t j = 0; j < extents.y; ++j)
        for (std::int64_t i = 0; i < extents.x; ++i) {
          const glm::i64vec3 index(i, j, k);
          const double off = std::abs(spline->evaluate(c, glm::dvec3(index)).value - volume.sample(0, index));
          const bool at_border = glm::any(glm::equal(index, glm::i64vec3(0))) || glm::any(glm::equal(index, extents - std::int64_t(1)));
          (at_border ? border : inside) = std::max(at_border ? border : inside, off);
        }
    EXPECT_LT(inside, 1e-13) << s.name;
    // Samples of noise in [-1,1].
    RecordProperty(std::string(s.name), std::to_string(border));
    EXPECT_GT(border, 0.05) << s.name;
    EXPECT_LT(border, 1.0) << s.name;
  }
}

/// The coefficients of a row whose ends go on for 200 more samples, by Thomas' elimination of side c(i-1) + (1 - 2 side) c(i) + side c(i+1) = f(i).
std::vector<long double> solved(const std::vector<double>& samples, double side) {
  constexpr std::size_t kMore = 200;
  std::vector<long double> f(kMore, samples.front());
  f.insert(f.end(), samples.begin(), samples.end());
  f.insert(f.end(), kMore, samples.back());
  // Far outside a coefficient is the sample.
  const long double a = side, b = 1.0L - 2.0L * a;
  std::vector<long double> upper(f.size(), 0.0L);
  for (std::size_t i = 1; i + 1 < f.size(); ++i) {
    const long double pivot = b - a * upper[i - 1];
    upper[i] = a / pivot;
    f[i] = (f[i] - a * f[i - 1]) / pivot;
  }
  for (std::size_t i = f.size() - 1; i-- > 1;) f[i] -= upper[i] * f[i + 1];
  return {f.begin() + kMore, f.end() - kMore};
}

TEST(Interpolation, AgreesWithTheExactInverseOnALongRow) {
  for (const Interpolating& s : kSplines) {
    for (int axis = 0; axis < 3; ++axis) {
      Extents extents(1);
      extents[axis] = 300;
      const Volume volume = random_volume(LatticeKind::cartesian, extents, 2);
      const auto c = make_spline(s.name)->coefficients(volume, kIir);
      std::vector<double> samples;
      glm::i64vec3 index(0);
      for (; index[axis] < 300; ++index[axis]) samples.push_back(volume.sample(0, index));
      const std::vector<long double> expected = solved(samples, s.side);
      for (index[axis] = 0; index[axis] < 300; ++index[axis])
        ASSERT_NEAR(c.data[c.number(0, index)], double(expected[std::size_t(index[axis])]), 2e-15) << s.name << ", axis " << axis << ", " << index[axis];
    }
  }
}

TEST(Interpolation, LeavesOutWeightsBelowHalfAnUlpOfOneAndNoOthers) {
  for (const Interpolating& s : kSplines) {
    const double pole = s.mask.pole, centre = (1.0 - pole) / (1.0 + pole);
    // The pole is a root of side z^2 + (1 - 2 side) z + side.
    EXPECT_NEAR(s.side * pole * pole + (1.0 - 2.0 * s.side) * pole + s.side, 0.0, 5e-17);
    EXPECT_GE(centre * std::pow(-pole, s.mask.reach), 0x1p-53) << s.name;
    EXPECT_LT(centre * std::pow(-pole, s.mask.reach + 1), 0x1p-53) << s.name;
    EXPECT_NEAR(centre * (1.0 - pole) / (1.0 + pole), s.mask.gain, 1e-14);
    const Spline::Filter& filter = make_spline(s.name)->filter(kIir);
    EXPECT_EQ(filter.reach, s.mask.reach);
    EXPECT_EQ(filter.gain, std::pow(s.mask.gain, 3));
  }
}

TEST(Interpolation, KeepsConstantsToTheLastBit) {
  const Volume volume = volume_of(LatticeKind::cartesian, {70, 2, 40}, [](const glm::dvec3&) { return 0.1; });
  for (const Interpolating& s : kSplines) EXPECT_THAT(make_spline(s.name)->coefficients(volume, kIir).data, testing::Each(double(0.1f)));
}

TEST(Interpolation, OfABoxCutOutWithItsReachIsThatOfTheVolumeToTheLastBit) {
  const Extents extents(90, 8, 75);
  const Volume volume = random_volume(LatticeKind::cartesian, extents, 3);
  for (const Interpolating& s : kSplines) {
    const auto spline = make_spline(s.name);
    const auto whole = spline->coefficients(volume, kIir);
    const glm::i64vec3 low(40, 0, 35), high(50, 8, 40);
    // How many coefficients of the box differ when it is cut out with a margin.
    const auto differences = [&](std::int64_t margin) {
      const glm::i64vec3 from = glm::max(low - margin, glm::i64vec3(0)), to = glm::min(high + margin, extents);
      Volume box = volume;
      box.extents = to - from;
      std::vector<float> samples;
      for (std::int64_t k = from.z; k < to.z; ++k)
        for (std::int64_t j = from.y; j < to.y; ++j)
          for (std::int64_t i = from.x; i < to.x; ++i) samples.push_back(float(volume.sample(0, {i, j, k})));
      box.samples = samples;
      const auto c = spline->coefficients(box, kIir);
      int differing = 0;
      for (std::int64_t k = low.z; k < high.z; ++k)
        for (std::int64_t j = low.y; j < high.y; ++j)
          for (std::int64_t i = low.x; i < high.x; ++i) differing += c.data[c.number(0, glm::i64vec3(i, j, k) - from)] != whole.data[whole.number(0, {i, j, k})];
      return differing;
    };
    EXPECT_EQ(differences(s.mask.reach), 0) << s.name;
    EXPECT_GT(differences(s.mask.reach / 2), 0) << s.name;
  }
}

}  // namespace
}  // namespace quincunx

#include "lattice/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

Volume sampled(LatticeKind lattice, const Extents& n, const std::function<double(const glm::dvec3&)>& f) {
  Volume volume{lattice, n, {}, std::vector<float>{}, {{"license", "none"}}};
  auto& samples = std::get<std::vector<float>>(volume.samples);
  for (int c = 0; c < coset_count(lattice); ++c)
    for (std::int64_t k = 0; k < n.z; ++k)
      for (std::int64_t j = 0; j < n.y; ++j)
        for (std::int64_t i = 0; i < n.x; ++i) samples.push_back(float(f(double(lattice_step(lattice)) * glm::dvec3(i, j, k) + double(c))));
  return volume;
}

/// What is left in the middle of a wave of that frequency along an axis, as a part of it, at the worst place.
std::pair<double, double> left_of(LatticeKind lattice, int axis, double frequency, double cutoff) {
  Extents n(lattice == LatticeKind::bcc ? 4 : 8);
  n[axis] = lattice == LatticeKind::bcc ? 80 : 160;
  const auto wave = [&](const glm::dvec3& u) { return std::cos(2.0 * M_PI * frequency * u[axis] + 0.3); };
  const Volume in = sampled(lattice, n, wave), out = low_pass(in, glm::dvec3(cutoff));
  double least = kNoLimit, most = 0.0;
  for (std::int64_t m = n[axis] / 2 - 8; m < n[axis] / 2 + 8; ++m)
    for (int c = 0; c < coset_count(lattice); ++c) {
      glm::i64vec3 index(n / std::int64_t(2));
      index[axis] = m;
      const double before = in.sample(c, index), after = out.sample(c, index);
      if (std::abs(before) > 0.3) least = std::min(least, after / before), most = std::max(most, after / before);
      most = std::max(most, std::abs(after));
    }
  return {least, most};
}

TEST(LowPass, KeepsWavesBelowTheCutOffAndRemovesThoseAbove) {
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc})
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low_least, low_most] = left_of(lattice, axis, 0.75 * 0.13, 0.13);
      EXPECT_GT(low_least, 0.97);
      EXPECT_LT(low_most, 1.01);
      const auto [half_least, half_most] = left_of(lattice, axis, 0.13, 0.13);
      EXPECT_GT(half_least, 0.49);
      EXPECT_LT(half_most, 0.52);
      EXPECT_LT(left_of(lattice, axis, 1.35 * 0.13, 0.13).second, 1e-3);
      EXPECT_LT(left_of(lattice, axis, 0.45, 0.13).second, 1e-3);
    }
}

TEST(LowPass, RemovesWhatOnlyTheTwoCosetsTogetherHold) {
  // cos(pi x) is 1 on the even coset and -1 on the odd one: constant on either.
  const Volume out = low_pass(sampled(LatticeKind::bcc, {30, 30, 30}, [](const glm::dvec3& u) { return std::cos(M_PI * u.x); }), glm::dvec3(0.15));
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(out.sample(c, {15, 15, 15}), 0.0, 1e-3);
}

TEST(LowPass, KeepsConstantsUpToTheBorderAndEverythingElseOfTheVolume) {
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc})
    for (const Extents& n : {Extents(7, 9, 5), Extents(1, 4, 30), Extents(1, 1, 1)}) {
      const Volume in = sampled(lattice, n, [](const glm::dvec3&) { return 41.5; }), out = low_pass(in, {0.2, 0.05, 0.3});
      EXPECT_EQ(out.extents, n);
      EXPECT_EQ(out.notes, in.notes);
      for (const float f : std::get<std::vector<float>>(out.samples)) EXPECT_NEAR(f, 41.5, 1e-5);
    }
}

TEST(LowPass, LeavesAxesWithoutCutOffAloneToTheLastBit) {
  const Volume in = sampled(LatticeKind::cartesian, {8, 9, 10}, [](const glm::dvec3& u) { return std::sin(u.x) + std::cos(3.0 * u.y) * u.z; });
  EXPECT_EQ(low_pass(in, glm::dvec3(kNoLimit)).samples, in.samples);
  // A function of x alone is not changed along y and z.
  const Volume of_x = sampled(LatticeKind::cartesian, {30, 3, 3}, [](const glm::dvec3& u) { return std::cos(2.0 * M_PI * 0.4 * u.x); });
  EXPECT_LT(std::abs(low_pass(of_x, {0.2, kNoLimit, kNoLimit}).sample(0, {15, 1, 1})), 1e-3);
  EXPECT_NEAR(low_pass(of_x, {kNoLimit, 0.2, 0.2}).sample(0, {15, 1, 1}), of_x.sample(0, {15, 1, 1}), 1e-6);
}

TEST(LowPass, RefusesSamplesThatAreNotFiniteAndTellsHowFarItIs) {
  Volume holed = sampled(LatticeKind::cartesian, {4, 4, 4}, [](const glm::dvec3& u) { return u.x == 2.0 ? std::numeric_limits<double>::quiet_NaN() : 1.0; });
  EXPECT_THROW(low_pass(holed, glm::dvec3(0.2)), InputError);
  double last = 0.0;
  const Volume in = sampled(LatticeKind::bcc, {8, 8, 8}, [](const glm::dvec3&) { return 1.0; });
  low_pass(in, glm::dvec3(0.2), [&](double fraction) { last = fraction; });
  EXPECT_EQ(last, 1.0);
  EXPECT_THROW(low_pass(in, glm::dvec3(0.2), [](double) { throw Interrupted(); }), Interrupted);
}

TEST(BandLimit, IsThatOfAsManySamplesOnEitherLattice) {
  // The cube of frequencies has the volume of one sample's share: 1 per sample of the Cartesian lattice, 1/4 of the BCC one.
  EXPECT_NEAR(std::pow(2.0 * band_limit(LatticeKind::cartesian), 3.0), 1.0, 1e-15);
  EXPECT_NEAR(std::pow(2.0 * band_limit(LatticeKind::bcc), 3.0), 0.25, 1e-15);
}

}  // namespace
}  // namespace quincunx

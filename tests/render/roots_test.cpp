#include "render/roots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace quincunx {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<double> crossings(const std::vector<double>& bernstein) {
  std::vector<double> x;
  append_crossings(bernstein, x);
  return x;
}

/// Bernstein coefficients of scale * product of (x - r): the product one factor (-r, 1-r) at a time, raising the degree.
std::vector<double> from_roots(const std::vector<double>& roots, double scale) {
  std::vector<double> b{scale};
  for (const double r : roots) {
    const int n = int(b.size());  // the new degree
    std::vector<double> next(n + 1, 0.0);
    for (int i = 0; i <= n; ++i) {
      if (i < n) next[i] += b[i] * -r * (n - i) / n;
      if (i > 0) next[i] += b[i - 1] * (1.0 - r) * i / n;
    }
    b = next;
  }
  return b;
}

TEST(Roots, OfOneSignIsNone) {
  EXPECT_THAT(crossings({1, 2, 3, 1, 5}), IsEmpty());
  EXPECT_THAT(crossings({-1, -2, -3, -1, -5}), IsEmpty());
  EXPECT_THAT(crossings({0, 0, 0, 0, 0}), IsEmpty()) << "0 counts as above";
}

TEST(Roots, OfRandomProductsAreTheFactors) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-0.5, 1.5);
  double worst = 0.0;
  for (int trial = 0; trial < 20000; ++trial) {
    const int degree = 1 + trial % 5;
    std::vector<double> roots(degree);
    for (double& r : roots) r = anywhere(random);
    std::sort(roots.begin(), roots.end());
    double gap = 1.0;
    for (int i = 1; i < degree; ++i) gap = std::min(gap, roots[i] - roots[i - 1]);
    for (const double r : roots) gap = std::min({gap, std::abs(r), std::abs(r - 1.0)});
    if (gap < 1e-3) continue;
    const std::vector<double> found = crossings(from_roots(roots, trial % 2 ? 1.0 : -7.0));
    std::erase_if(roots, [](double r) { return r < 0.0 || r > 1.0; });
    ASSERT_EQ(found.size(), roots.size()) << "trial " << trial;
    // The condition of a root grows as gaps shrink: rounding over gap^(degree-1).
    for (std::size_t i = 0; i < roots.size(); ++i)
      worst = std::max(worst, std::abs(found[i] - roots[i]) * std::pow(gap, degree - 1));
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(Roots, PairsAreTakenApartDownToTheRoundingOfTheirCoefficients) {
  // (x - r)(x - r - gap): two crossings however near, as long as the coefficients can hold the dip between them.
  for (double gap = 1e-1; gap > 2e-8; gap /= 3.0) {
    const auto found = crossings(from_roots({0.3, 0.3 + gap}, 1.0));
    ASSERT_EQ(found.size(), 2u) << gap;
    EXPECT_NEAR(found[1] - found[0], gap, 1e-15 / gap);
  }
}

TEST(Roots, TouchingFromBelowIsThereAndBackAndFromAboveIsNothing) {
  // -(2x - 1)^2 and -(8x - 3)^2, where the halving meets the place, and -(3x - 1)^2, where it does not.
  const std::vector<std::pair<double, std::vector<double>>> squares = {
      {0.5, {1, -1, 1}}, {0.375, {9, -15, 25}}, {1.0 / 3.0, {1, -2, 4}}};
  for (const auto& [place, square] : squares) {
    EXPECT_THAT(crossings(square), IsEmpty()) << place;
    const auto found = crossings({-square[0], -square[1], -square[2]});
    ASSERT_EQ(found.size(), 2u) << place;
    for (const double x : found) EXPECT_NEAR(x, place, 1e-14);
  }
}

TEST(Roots, AtTheEndsCountWhereTheSideChanges) {
  EXPECT_THAT(crossings({-1, -1, 0}), ElementsAre(1.0)) << "arrives at 0";
  EXPECT_THAT(crossings({1, 1, 0}), IsEmpty()) << "0 is on the side of 1";
  ASSERT_EQ(crossings({0, -1, -1}).size(), 1u) << "leaves 0 downwards at once";
  EXPECT_NEAR(crossings({0, -1, -1})[0], 0.0, 1e-15);
  EXPECT_THAT(crossings({0, 1, 1}), IsEmpty());
  // x (0.3 - x) leaves 0 upwards; its crossing is at 0.3 and not the zero at 0. (1 - x)(x - 0.3): likewise at 1.
  EXPECT_THAT(crossings({0, 0.15, -0.7}), ElementsAre(::testing::DoubleNear(0.3, 1e-15)));
  EXPECT_THAT(crossings({-0.3, 0.35, 0}), ElementsAre(::testing::DoubleNear(0.3, 1e-15)));
}

TEST(Roots, OfHighMultiplicityAreFoundOnce) {
  // (x - 3/8)^3, and (x - 1/3)^5 where only cube-root (fifth-root) accuracy is in the coefficients.
  for (const auto& [r, n, tolerance] : {std::tuple{0.375, 3, 1e-5}, {1.0 / 3.0, 5, 1e-3}}) {
    const auto found = crossings(from_roots(std::vector<double>(n, r), 1.0));
    ASSERT_GE(found.size(), 1u);
    EXPECT_EQ(found.size() % 2, 1u) << "the sides of the ends differ";
    for (const double x : found) EXPECT_NEAR(x, r, tolerance);
  }
}

TEST(Roots, NoiseAroundZeroEndsQuicklyAndKeepsTheSides) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> noise(-2, 2);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<double> b(5);
    for (double& x : b) x = noise(random) * 0x1p-52;
    const auto found = crossings(b);
    EXPECT_LE(found.size(), 4u);
    EXPECT_EQ(found.size() % 2 == 1, (b[0] >= 0.0) != (b[4] >= 0.0));
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (const double x : found) EXPECT_TRUE(x >= 0.0 && x <= 1.0);
  }
}

TEST(Roots, RightAfterTheStartAreFoundAtTheStart) {
  const auto found = crossings({-std::numeric_limits<double>::min(), 1, 2, 3, 4});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], 0.0, 1e-15);
}

}  // namespace
}  // namespace quincunx

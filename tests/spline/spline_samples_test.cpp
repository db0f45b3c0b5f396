#include "spline/spline_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lattice/error.h"
#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

/// Resamples f, given on a lattice of 24 cells or so, on the other one, and returns the largest error at least `border` cells off the border.
double largest_error(std::string_view name, const std::function<double(const glm::dvec3&)>& f, LatticeKind to, const Extents& extents, double border) {
  const auto spline = make_spline(name);
  const LatticeKind from = spline->lattice();
  const Volume volume = volume_of(from, from == LatticeKind::bcc ? Extents(13) : Extents(26), f);
  const TargetGrid grid = grid_of_extents(volume, to, extents);
  const Volume out = spline_samples(*spline, spline->coefficients(volume, Spline::Prefilter::automatic), grid, SampleType::float32);
  const glm::dvec3 far(domain_max(from, volume.extents));
  double largest = 0.0;
  int compared = 0;
  for (int c = 0; c < coset_count(to); ++c)
    for (std::int64_t k = 0; k < extents.z; ++k)
      for (std::int64_t j = 0; j < extents.y; ++j)
        for (std::int64_t i = 0; i < extents.x; ++i) {
          const glm::dvec3 u = grid.world.to_world(glm::dvec3(lattice_step(to)) * glm::dvec3(i, j, k) + double(c));
          if (glm::any(glm::lessThan(glm::min(u, far - u), glm::dvec3(border)))) continue;
          largest = std::max(largest, std::abs(out.sample(c, {i, j, k}) - f(u)));
          ++compared;
        }
  EXPECT_GT(compared, 400);
  return largest;
}

TEST(SplineSamples, OfAQuadraticAreExactAwayFromTheBorder) {
  const auto quadratic = [](const glm::dvec3& u) { return u.x * u.x - 2.0 * u.y * u.z + 3.0 * u.z - 7.0 * u.y + 11.0; };  // up to 1200
  for (const LatticeKind to : {LatticeKind::cartesian, LatticeKind::bcc}) {
    EXPECT_LT(largest_error("bcc7", quadratic, to, {15, 19, 14}, 5.0), 1e-4);
    EXPECT_LT(largest_error("tricubic", quadratic, to, {15, 19, 14}, 3.0), 1e-4);
  }
  const auto trilinear = [](const glm::dvec3& u) { return u.x * u.y * u.z / 64.0 - u.x; };
  EXPECT_LT(largest_error("trilinear", trilinear, LatticeKind::bcc, {15, 19, 14}, 0.0), 1e-4);
}

TEST(SplineSamples, OfABandLimitedFieldAgreeOnBothLattices) {
  // Waves of 20 cells or more: the fourth power of 2 pi / 20 is 0.01, of which splines of order 4 leave some hundredths; there are 4 BCC cells to a sample,
  // whose steps are longer: 2.5 times the error.
  const auto waves = [](const glm::dvec3& u) { return std::sin(0.3 * u.x + 0.1) + std::cos(0.25 * u.y - 0.15 * u.z) + 0.5 * std::sin(0.2 * (u.x + u.y) + 0.2 * u.z); };
  EXPECT_LT(largest_error("tricubic", waves, LatticeKind::bcc, {20, 20, 20}, 3.0), 1e-3);
  EXPECT_LT(largest_error("bcc7", waves, LatticeKind::cartesian, {20, 20, 20}, 5.0), 4e-3);
}

TEST(SplineSamples, OfIntegerTypesAreRoundedAndStayInRange) {
  const auto spline = make_spline("trilinear");
  const Volume volume = volume_of(LatticeKind::cartesian, {5, 2, 2}, [](const glm::dvec3& u) { return 100.0 * u.x - 50.3; });
  const auto c = spline->coefficients(volume, Spline::Prefilter::automatic);
  const Volume bytes = spline_samples(*spline, c, grid_of_extents(volume, LatticeKind::cartesian, {5, 2, 2}), SampleType::uint8);
  EXPECT_EQ(bytes.type(), SampleType::uint8);
  for (const auto& [i, expected] : {std::pair{0, 0}, {1, 50}, {2, 150}, {3, 250}, {4, 255}}) EXPECT_EQ(bytes.sample(0, {i, 1, 1}), expected);
  const Volume words = spline_samples(*spline, c, grid_of_extents(volume, LatticeKind::cartesian, {9, 2, 2}), SampleType::int16);
  EXPECT_EQ(words.sample(0, {0, 0, 0}), -50);
  EXPECT_EQ(words.sample(0, {1, 0, 0}), 0);
}

TEST(SplineSamples, AreRefusedBeforeTheyFillTheMemoryAndStopWhenAsked) {
  const auto spline = make_spline("trilinear");
  const Volume volume = volume_of(LatticeKind::cartesian, {4, 4, 4}, [](const glm::dvec3&) { return 1.0; });
  const auto c = spline->coefficients(volume, Spline::Prefilter::automatic);
  EXPECT_THROW(spline_samples(*spline, c, grid_of_extents(volume, LatticeKind::bcc, Extents(1000000)), SampleType::float32), InputError);
  EXPECT_THROW(spline_samples(*spline, c, grid_of_extents(volume, LatticeKind::bcc, Extents(9)), SampleType::float32, [](double) { throw Interrupted(); }), Interrupted);
}

}  // namespace
}  // namespace quincunx

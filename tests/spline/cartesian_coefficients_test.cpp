// The prefilters on the Cartesian lattice and its border rule; and of every spline, that boxes can be prefiltered apart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "lattice/error.h"
#include "spline/tricubic.h"
#include "spline/trilinear.h"
#include "spline/triquadratic.h"
#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

constexpr auto kPrefiltered = Spline::Prefilter::automatic;

const Extents kCartesianExtents[] = {{3, 4, 5}, {1, 1, 6}, {1, 1, 1}, {5, 1, 2}, {2, 2, 2}};

double clamped_sample(const Volume& volume, const glm::i64vec3& index) {
  return volume.sample(0, glm::clamp(index, glm::i64vec3(0), volume.extents - std::int64_t(1)));
}

/// The tensor product of (-side, 1 + 2 side, -side) at an index, over its 27 samples.
double filtered(const Volume& volume, const glm::i64vec3& index, double side) {
  const double weights[3] = {-side, 1.0 + 2.0 * side, -side};
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a)
        sum += weights[a] * weights[b] * weights[c] *
               clamped_sample(volume, index + glm::i64vec3(a - 1, b - 1, c - 1));
  return sum;
}

constexpr double kCubicSide = 1.0 / 6.0, kQuadraticSide = 1.0 / 8.0;

TEST(CartesianCoefficients, AreTheDefinitionWithClampedSamplesAndClampedAprons) {
  for (const Extents& extents : kCartesianExtents) {
    const Volume volume = random_volume(LatticeKind::cartesian, extents, 1);
    const auto c = Tricubic().coefficients(volume, kPrefiltered);
    const auto quadratic = Triquadratic().coefficients(volume, kPrefiltered);
    const auto plain = Trilinear().coefficients(volume, kPrefiltered);
    const bool thin = std::min({extents.x, extents.y, extents.z}) == 1;
    EXPECT_EQ(c.apron, thin ? 2 : 1);
    EXPECT_EQ(quadratic.apron, c.apron);
    EXPECT_EQ(plain.apron, thin ? 1 : 0);
    const auto check = [&](const Coefficients<double>& found, const auto& value) {
      const glm::i64vec3 p = found.padded();
      ASSERT_EQ(found.data.size(), std::size_t(p.x * p.y * p.z));
      for (std::int64_t n = 0; n < p.x * p.y * p.z; ++n) {
        const glm::i64vec3 index = glm::i64vec3(n % p.x, n / p.x % p.y, n / (p.x * p.y)) - std::int64_t(found.apron);
        EXPECT_NEAR(found.data[std::size_t(n)], value(glm::clamp(index, glm::i64vec3(0), extents - std::int64_t(1))), 3e-15);
      }
    };
    check(c, [&](const glm::i64vec3& index) { return filtered(volume, index, kCubicSide); });
    check(quadratic, [&](const glm::i64vec3& index) { return filtered(volume, index, kQuadraticSide); });
    check(plain, [&](const glm::i64vec3& index) { return clamped_sample(volume, index); });
  }
}

TEST(CartesianCoefficients, HoldTheStencilOfEveryPointAndCellOfTheSmallestDomains) {
  for (const auto& [name, side] : {std::pair{"trilinear", 0.0}, {"triquadratic", kQuadraticSide}, {"tricubic", kCubicSide}, {"catmull-rom", 0.0}}) {
    const auto spline = make_spline(name);
    for (const Extents& extents : kCartesianExtents) {
      const Volume volume = random_volume(LatticeKind::cartesian, extents, 2);
      const auto c = spline->coefficients(volume, kPrefiltered);
      const glm::dvec3 last(domain_max(LatticeKind::cartesian, extents));
      for (const double x : {0.0, 1e-9, 0.5, 1.0})
        for (const double y : {0.0, 0.5, 1.0 - 1e-9, 1.0})
          for (const double z : {0.0, 0.3, 1.0}) {
            const glm::dvec3 u = glm::dvec3(x, y, z) * last;
            double sum = 0.0;
            for_lattice_points(LatticeKind::cartesian, u, 2.0, [&](int, const glm::i64vec3& index, const glm::dvec3& j) {
              const auto inside = glm::clamp(index, glm::i64vec3(0), extents - std::int64_t(1));
              const double coefficient = filtered(volume, inside, side);
              sum += coefficient * spline->generator(u - j).value;
            });
            EXPECT_NEAR(spline->evaluate(c, u).value, sum, 4e-15) << name;
            // All of the last cell lies in the array, beyond the domain too; there an axis of one sample changes nothing.
            std::vector<double> bernstein(std::size_t(spline->degree()) + 1);
            const glm::ivec3 cell(cell_count(LatticeKind::cartesian, extents) - std::int64_t(1));
            glm::dvec3 corner(cell);
            for (int a = 0; a < 3; ++a) corner[a] += extents[a] == 1 ? 0.0 : 1.0;
            spline->restrict_to_segment(c, cell, glm::dvec3(cell), glm::dvec3(cell + 1), bernstein);
            EXPECT_NEAR(bernstein.back(), spline->evaluate(c, corner).value, 4e-15) << name;
          }
    }
  }
}

TEST(CartesianCoefficients, AreTheSamplesWithoutPrefilterAndTheirRoundingInFloats) {
  const Tricubic spline;
  const Volume volume = random_volume(LatticeKind::cartesian, {3, 2, 4}, 3);
  const auto plain = spline.coefficients(volume, Spline::Prefilter::none);
  EXPECT_EQ(plain.data[plain.number(0, {2, 1, 3})], volume.sample(0, {2, 1, 3}));
  EXPECT_EQ(plain.data[plain.number(0, {-1, 1, 4})], volume.sample(0, {0, 1, 3}));
  const auto filtered = spline.coefficients(volume, kPrefiltered);
  const auto rounded = spline.coefficients_float(volume, kPrefiltered);
  ASSERT_EQ(filtered.data.size(), rounded.data.size());
  for (std::size_t n = 0; n < filtered.data.size(); ++n) EXPECT_EQ(rounded.data[n], float(filtered.data[n]));
}

TEST(CartesianCoefficients, OfEverySampleTypeAgree) {
  const Tricubic spline;
  Volume volume = volume_of(LatticeKind::cartesian, {4, 3, 2},
                            [](const glm::dvec3& u) { return std::fmod(u.x * 37 + u.y * 11 + u.z * 5, 251.0); });
  const auto expected = spline.coefficients(volume, kPrefiltered).data;
  const auto floats = std::get<std::vector<float>>(volume.samples);
  volume.samples = std::vector<std::uint8_t>(floats.begin(), floats.end());
  EXPECT_EQ(spline.coefficients(volume, kPrefiltered).data, expected);
  volume.samples = std::vector<std::int16_t>(floats.begin(), floats.end());
  EXPECT_EQ(spline.coefficients(volume, kPrefiltered).data, expected);
  volume.samples = std::vector<std::uint16_t>(floats.begin(), floats.end());
  EXPECT_EQ(spline.coefficients(volume, kPrefiltered).data, expected);
}

TEST(CartesianCoefficients, OfAConstantAreThatConstant) {
  const auto c = Tricubic().coefficients(
      volume_of(LatticeKind::cartesian, {3, 3, 3}, [](const glm::dvec3&) { return 130.0; }), kPrefiltered);
  EXPECT_THAT(c.data, testing::Each(130.0));
}

std::string tricubic_refusal(const Volume& volume) {
  try {
    Tricubic().coefficients_float(volume, kPrefiltered);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CartesianCoefficients, RefuseTheOtherLatticeAndSamplesThatAreNotFiniteOrOverflow) {
  EXPECT_THAT(tricubic_refusal(random_volume(LatticeKind::bcc, {3, 4, 5}, 5)),
              testing::HasSubstr("tricubic: found a volume on the bcc lattice, expected cartesian"));
  Volume volume = random_volume(LatticeKind::cartesian, {3, 4, 5}, 4);
  std::get<std::vector<float>>(volume.samples)[2 * 12 + 3 * 3 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(tricubic_refusal(volume), testing::HasSubstr("found 1 NaN or infinite of 60 samples, the first at index (1, 3, 2)"));
  volume = volume_of(LatticeKind::cartesian, {2, 2, 2}, [](const glm::dvec3& u) { return u.x == 0.0 ? 3e38 : -3e38; });
  EXPECT_THAT(tricubic_refusal(volume), testing::HasSubstr("overflow float"));
}

/// The samples of an index box of a volume.
Volume cut_out(const Volume& volume, const glm::i64vec3& low, const glm::i64vec3& high) {
  Volume box = volume;
  box.extents = high - low;
  std::vector<float> samples;
  for (int c = 0; c < coset_count(volume.lattice); ++c)
    for (std::int64_t k = low.z; k < high.z; ++k)
      for (std::int64_t j = low.y; j < high.y; ++j)
        for (std::int64_t i = low.x; i < high.x; ++i) samples.push_back(float(volume.sample(c, {i, j, k})));
  box.samples = std::move(samples);
  return box;
}

TEST(EverySplinesCoefficients, OfABoxCutOutWithItsReachAreThoseOfTheVolumeToTheLastBitAndWithoutItAreNot) {
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    const Extents extents(11, 10, 9);
    const Volume volume = random_volume(spline->lattice(), extents, 7);
    const auto whole = spline->coefficients_float(volume, kPrefiltered);
    // How many coefficients of the boxes differ when they are cut out with a margin.
    const auto differences = [&](std::int64_t margin) {
      int differing = 0;
      for (const glm::i64vec3& low : {glm::i64vec3(0), glm::i64vec3(3, 4, 5), glm::i64vec3(7, 0, 2)}) {
        const glm::i64vec3 high = glm::min(low + std::int64_t(4), extents);
        const glm::i64vec3 from = glm::max(low - margin, glm::i64vec3(0)), to = glm::min(high + margin, extents);
        const auto box = spline->coefficients_float(cut_out(volume, from, to), kPrefiltered);
        for (int c = 0; c < coset_count(volume.lattice); ++c)
          for (std::int64_t k = low.z; k < high.z; ++k)
            for (std::int64_t j = low.y; j < high.y; ++j)
              for (std::int64_t i = low.x; i < high.x; ++i) {
                const glm::i64vec3 index(i, j, k);
                differing += box.data[box.number(c, index - from)] != whole.data[whole.number(c, index)];
              }
      }
      return differing;
    };
    const int reach = spline->filter(kPrefiltered).reach;
    EXPECT_EQ(differences(reach), 0) << name;
    if (reach == 0) continue;
    EXPECT_GT(differences(reach - 1), 0) << name;
  }
}

}  // namespace
}  // namespace quincunx

// The prefilter and the border rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <mutex>

#include "lattice/error.h"
#include "spline/bcc7.h"
#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

/// The sample at a lattice point, each index of its coset clamped.
double clamped_sample(const Volume& volume, const glm::ivec3& u) {
  const int coset = u.x & 1;
  const glm::i64vec3 index = glm::floor(glm::dvec3(u - coset) / 2.0);
  return volume.sample(coset, glm::clamp(index, glm::i64vec3(0), volume.extents - std::int64_t(1)));
}

/// q7 at a lattice point from the definition: 19/12 at the centre, -1/24 at the 14 points +-xi.
double q7(const Volume& volume, const glm::ivec3& u) {
  double neighbours = 0.0;
  for (const glm::ivec3& xi : {glm::ivec3(2, 0, 0), glm::ivec3(0, 2, 0), glm::ivec3(0, 0, 2), glm::ivec3(-1, 1, 1),
                               glm::ivec3(1, -1, 1), glm::ivec3(1, 1, -1), glm::ivec3(-1, -1, -1)})
    neighbours += clamped_sample(volume, u + xi) + clamped_sample(volume, u - xi);
  return 19.0 / 12.0 * clamped_sample(volume, u) - neighbours / 24.0;
}

const Extents kBccExtents[] = {{3, 4, 5}, {1, 1, 6}, {1, 1, 1}, {5, 1, 2}};

TEST(Coefficients, AreTheDefinitionOfQ7WithClampedSamplesAndClampedAprons) {
  const Bcc7 spline;
  for (const Extents& extents : kBccExtents) {
    const Volume volume = random_volume(LatticeKind::bcc, extents, 1);
    const auto c = spline.coefficients(volume, Spline::Prefilter::automatic);
    ASSERT_EQ(c.data.size(), std::size_t(2 * (extents.x + 2) * (extents.y + 2) * (extents.z + 2)));
    for (int coset = 0; coset < 2; ++coset)
      for (std::int64_t k = -1; k <= extents.z; ++k)
        for (std::int64_t j = -1; j <= extents.y; ++j)
          for (std::int64_t i = -1; i <= extents.x; ++i) {
            const auto inside = glm::clamp(glm::i64vec3(i, j, k), glm::i64vec3(0), extents - std::int64_t(1));
            EXPECT_NEAR(c.data[c.number(coset, {i, j, k})], q7(volume, glm::ivec3(inside) * 2 + coset), 1e-15);
          }
  }
}

TEST(Coefficients, GiveTheClampedSplineOnTheBorderOfTheSmallestDomains) {
  const Bcc7 spline;
  for (const Extents& extents : kBccExtents) {
    const Volume volume = random_volume(LatticeKind::bcc, extents, 2);
    const auto c = spline.coefficients(volume, Spline::Prefilter::automatic);
    const glm::dvec3 last(domain_max(LatticeKind::bcc, extents));
    // Corners, middles of edges and faces, and points just inside.
    for (const double x : {0.0, 1e-9, 0.5, 1.0})
      for (const double y : {0.0, 0.5, 1.0 - 1e-9, 1.0})
        for (const double z : {0.0, 0.3, 1.0}) {
          const glm::dvec3 u = glm::dvec3(x, y, z) * last;
          double sum = 0.0;
          for_lattice_points(LatticeKind::bcc, u, 3.0, [&](int coset, const glm::i64vec3& index, const glm::dvec3& j) {
            const auto inside = glm::clamp(index, glm::i64vec3(0), extents - std::int64_t(1));
            sum += q7(volume, glm::ivec3(inside) * 2 + coset) * spline.generator(u - j).value;
          });
          EXPECT_NEAR(spline.evaluate(c, u).value, sum, 3e-15);
        }
  }
}

TEST(Coefficients, AreTheSamplesWithoutPrefilterAndTheirRoundingInFloats) {
  const Bcc7 spline;
  const Volume volume = random_volume(LatticeKind::bcc, {3, 2, 4}, 3);
  const auto plain = spline.coefficients(volume, Spline::Prefilter::none);
  EXPECT_EQ(plain.data[plain.number(1, {2, 1, 3})], volume.sample(1, {2, 1, 3}));
  EXPECT_EQ(plain.data[plain.number(0, {-1, 1, 4})], volume.sample(0, {0, 1, 3}));
  const auto filtered = spline.coefficients(volume, Spline::Prefilter::automatic);
  const auto rounded = spline.coefficients_float(volume, Spline::Prefilter::automatic);
  ASSERT_EQ(filtered.data.size(), rounded.data.size());
  for (std::size_t n = 0; n < filtered.data.size(); ++n) EXPECT_EQ(rounded.data[n], float(filtered.data[n]));
}

TEST(Coefficients, OfEverySampleTypeAgree) {
  const Bcc7 spline;
  Volume volume = volume_of(LatticeKind::bcc, {4, 3, 2},
                            [](const glm::dvec3& u) { return std::fmod(u.x * 37 + u.y * 11 + u.z * 5, 251.0); });
  const auto expected = spline.coefficients(volume, Spline::Prefilter::automatic).data;
  const auto floats = std::get<std::vector<float>>(volume.samples);
  volume.samples = std::vector<std::uint8_t>(floats.begin(), floats.end());
  EXPECT_EQ(spline.coefficients(volume, Spline::Prefilter::automatic).data, expected);
  volume.samples = std::vector<std::int16_t>(floats.begin(), floats.end());
  EXPECT_EQ(spline.coefficients(volume, Spline::Prefilter::automatic).data, expected);
  volume.samples = std::vector<std::uint16_t>(floats.begin(), floats.end());
  EXPECT_EQ(spline.coefficients(volume, Spline::Prefilter::automatic).data, expected);
}

TEST(Coefficients, OfAConstantAreThatConstant) {
  const Bcc7 spline;
  const auto c = spline.coefficients(volume_of(LatticeKind::bcc, {3, 3, 3}, [](const glm::dvec3&) { return 130.0; }),
                                     Spline::Prefilter::automatic);
  EXPECT_THAT(c.data, testing::Each(130.0));
}

/// The message of the InputError that making coefficients ends in.
std::string bcc7_refusal(const Volume& volume) {
  try {
    Bcc7().coefficients_float(volume, Spline::Prefilter::automatic);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Coefficients, RefuseSamplesThatAreNotFiniteAndSayHowManyAndWhere) {
  Volume volume = random_volume(LatticeKind::bcc, {3, 4, 5}, 4);
  auto& samples = std::get<std::vector<float>>(volume.samples);
  samples[60 + 2 * 12 + 3 * 3 + 1] = std::numeric_limits<float>::quiet_NaN();
  samples[60 + 4 * 12] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(bcc7_refusal(volume), testing::AllOf(testing::HasSubstr("found 2 NaN or infinite of 120"),
                                              testing::HasSubstr("coset 1, index (1, 3, 2)")));
}

TEST(Coefficients, RefuseTheOtherLatticeAndSamplesThatOverflowAndSamplesThatAreMissing) {
  Volume volume = random_volume(LatticeKind::cartesian, {3, 4, 5}, 5);
  EXPECT_THAT(bcc7_refusal(volume), testing::HasSubstr("found a volume on the cartesian lattice, expected bcc"));
  volume = volume_of(LatticeKind::bcc, {2, 2, 2}, [](const glm::dvec3& u) { return u.x == 0.0 ? 3e38 : -3e38; });
  EXPECT_THAT(bcc7_refusal(volume), testing::HasSubstr("overflow float"));
  std::get<std::vector<float>>(volume.samples).pop_back();
  EXPECT_NE(bcc7_refusal(volume), "accepted");
}

TEST(Coefficients, ReportProgressToTheEndOneThreadAtATimeAndStopWhenAsked) {
  const Bcc7 spline;
  const Volume volume = random_volume(LatticeKind::bcc, {4, 4, 64}, 6);
  std::mutex reporting;
  double last = 0.0;
  const auto listen = [&](double fraction) {
    ASSERT_TRUE(reporting.try_lock());
    last = fraction;
    reporting.unlock();
  };
  spline.coefficients(volume, Spline::Prefilter::automatic, listen);
  EXPECT_EQ(last, 1.0);
  EXPECT_THROW(spline.coefficients(volume, Spline::Prefilter::none, [](double) { throw Interrupted(); }), Interrupted);
}

}  // namespace
}  // namespace quincunx

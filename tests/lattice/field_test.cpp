#include "lattice/field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "lattice/error.h"

namespace quincunx {
namespace {

glm::dvec3 random_point(std::mt19937& random) {
  const auto coordinate = [&] { return 2.0 * (double(random()) / 4294967295.0) - 1.0; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

TEST(Field, EveryNameOfTheListIsMadeAndKnowsItsName) {
  EXPECT_THAT(field_names(), testing::ElementsAre("marschner-lobb", "sphere", "torus", "gyroid", "waves", "quartic"));
  for (const std::string_view name : field_names()) EXPECT_EQ(make_field(name)->name(), name);
}

TEST(Field, AnUnknownNameIsRefusedNamingTheChoices) {
  try {
    make_field("cube");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("'cube'"), testing::HasSubstr("marschner-lobb, sphere")));
  }
}

TEST(Field, GradientsAreTheDerivativesOfTheValues) {
  std::mt19937 random(11);
  for (const std::string_view name : field_names()) {
    const auto field = make_field(name, 3);
    for (int n = 0; n < 200; ++n) {
      const glm::dvec3 x = random_point(random);
      const glm::dvec3 g = field->gradient(x);
      for (int axis = 0; axis < 3; ++axis) {
        // Fourth-order central difference: error h^4/30 times the fifth derivative, which reaches 60^5 / 10.
        const auto at = [&](double offset) {
          glm::dvec3 y = x;
          y[axis] += offset;
          return field->value(y);
        };
        const double h = 2.5e-4;
        const double difference = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
        EXPECT_NEAR(g[axis], difference, 1e-7) << name << " axis " << axis;
      }
    }
  }
}

TEST(Field, TheGradientOfMarschnerLobbIsFiniteOnItsAxis) {
  const auto field = make_field("marschner-lobb");
  const glm::dvec3 g = field->gradient({0.0, 0.0, 0.25});
  EXPECT_EQ(g.x, 0.0);
  EXPECT_EQ(g.y, 0.0);
  EXPECT_LT(g.z, 0.0);
}

TEST(Field, KnownValues) {
  // cos(12 pi) = 1 at the centre: (1 + 2 alpha) / (2 (1 + alpha)) = 0.6.
  EXPECT_NEAR(make_field("marschner-lobb")->value({0, 0, 0}), 0.6, 1e-14);
  // sin = 1 and, with r = 1, cos(0) = 1: 2 alpha / (2 (1 + alpha)) = 0.2.
  EXPECT_NEAR(make_field("marschner-lobb")->value({0, 1, 1}), 0.2, 1e-14);
  EXPECT_NEAR(make_field("sphere")->value({0.0, 0.8, 0.0}), 0.0, 1e-15);
  EXPECT_NEAR(make_field("sphere")->value({0.0, 0.0, 0.0}), 0.64, 1e-15);
  // The torus runs through R +- r along x and through r above its ring.
  EXPECT_NEAR(make_field("torus")->value({0.85, 0.0, 0.0}), 0.0, 1e-15);
  EXPECT_NEAR(make_field("torus")->value({0.0, 0.35, 0.0}), 0.0, 1e-15);
  EXPECT_NEAR(make_field("torus")->value({0.36, 0.48, 0.25}), 0.0, 1e-15);
  EXPECT_GT(make_field("torus")->value({0.6, 0.0, 0.0}), 0.0);
  // Period 1 along every axis, hence two periods across the cube; sin(pi/2) cos(0) = 1.
  const auto gyroid = make_field("gyroid");
  EXPECT_NEAR(gyroid->value({0.25, 0.0, 0.25}), 1.0 + 0.0 + 0.0, 1e-14);
  EXPECT_NEAR(gyroid->value({0.1, 0.2, 0.3}), gyroid->value({-0.9, 0.2, 0.3}), 1e-14);
  EXPECT_GT(std::abs(gyroid->value({0.1, 0.2, 0.3}) - gyroid->value({-0.4, 0.2, 0.3})), 0.1);
}

TEST(Field, TheQuarticHasTotalDegreeFourAlongAnyLine) {
  const auto field = make_field("quartic", 5);
  std::mt19937 random(2);
  for (int n = 0; n < 20; ++n) {
    const glm::dvec3 o = random_point(random), d = random_point(random);
    const auto difference = [&](std::initializer_list<double> binomials) {
      double sum = 0.0, t = 0.0;
      for (const double b : binomials) sum += b * field->value(o + t * d), t += 0.25;
      return sum;
    };
    EXPECT_NEAR(difference({-1, 5, -10, 10, -5, 1}), 0.0, 1e-13);  // fifth difference of a quartic
    EXPECT_GT(std::abs(difference({1, -4, 6, -4, 1})), 1e-8);      // and not a cubic
  }
}

TEST(Field, TheSeedChoosesTheQuartic) {
  const glm::dvec3 x(0.3, -0.2, 0.7);
  EXPECT_EQ(make_field("quartic", 4)->value(x), make_field("quartic", 4)->value(x));
  EXPECT_NE(make_field("quartic", 4)->value(x), make_field("quartic", 5)->value(x));
}

TEST(Field, EverySurfaceIsInsideTheCube) {
  for (const std::string_view name : field_names()) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const auto field = make_field(name, seed);
      const SampleRange range = sample_range(sample_field(*field, LatticeKind::cartesian, {17, 17, 17}));
      EXPECT_LT(range.min, field->isovalue()) << name;
      EXPECT_GT(range.max, field->isovalue()) << name;
    }
  }
}

TEST(SampleField, EverySampleIsTheFieldAtItsPlaceAndTheDomainIsTheCube) {
  const auto field = make_field("quartic", 9);
  for (const LatticeKind lattice : {LatticeKind::bcc, LatticeKind::cartesian}) {
    const Extents extents(5, 3, 4);
    const Volume volume = sample_field(*field, lattice, extents);
    EXPECT_NO_THROW(check_volume(volume, "v"));
    EXPECT_EQ(volume.type(), SampleType::float32);
    EXPECT_EQ(volume.world.to_world({0, 0, 0}), glm::dvec3(-1.0));
    EXPECT_LT(glm::length(volume.world.to_world(glm::dvec3(domain_max(lattice, extents))) - glm::dvec3(1.0)), 1e-15);
    for (int c = 0; c < coset_count(lattice); ++c)
      for (std::int64_t k = 0; k < extents.z; ++k)
        for (std::int64_t j = 0; j < extents.y; ++j)
          for (std::int64_t i = 0; i < extents.x; ++i) {
            const glm::dvec3 u = double(lattice_step(lattice)) * glm::dvec3(i, j, k) + double(c);
            EXPECT_EQ(volume.sample(c, {i, j, k}), double(float(field->value(volume.world.to_world(u)))));
          }
  }
}

TEST(SampleField, AnAxisOfOneVoxelStandsAtZero) {
  const auto field = make_field("sphere");
  const Volume volume = sample_field(*field, LatticeKind::cartesian, {3, 3, 1});
  EXPECT_EQ(volume.world.to_world({1, 1, 0}), glm::dvec3(0.0));
  EXPECT_EQ(volume.sample(0, {1, 1, 0}), double(0.64f));
  EXPECT_NE(glm::determinant(volume.world.axes), 0.0);
}

TEST(SampleField, ExtentsThatAreZeroOrAbsurdAreRefusedBeforeAnythingIsAllocated) {
  const auto field = make_field("sphere");
  const std::int64_t huge = std::int64_t(1) << 40;
  EXPECT_THROW(sample_field(*field, LatticeKind::bcc, {0, 4, 4}), InputError);
  EXPECT_THROW(sample_field(*field, LatticeKind::bcc, {4, -4, 4}), InputError);
  EXPECT_THROW(sample_field(*field, LatticeKind::bcc, {huge, 1, 1}), InputError);
  EXPECT_THROW(sample_field(*field, LatticeKind::bcc, {huge, huge, huge}), InputError);
}

TEST(SampleField, ProgressRisesFromZeroToOneOnTheCallersThread) {
  const auto field = make_field("sphere");
  const auto caller = std::this_thread::get_id();
  std::vector<double> fractions;
  sample_field(*field, LatticeKind::bcc, {64, 64, 64}, [&](double fraction) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    fractions.push_back(fraction);
  });
  ASSERT_GE(fractions.size(), 3u);
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
}

TEST(SampleField, AnInterruptFromProgressIsLetThrough) {
  const auto field = make_field("sphere");
  EXPECT_THROW(sample_field(*field, LatticeKind::bcc, {64, 64, 64},
                            [](double fraction) {
                              if (fraction > 0.0) throw Interrupted();
                            }),
               Interrupted);
}

}  // namespace
}  // namespace quincunx

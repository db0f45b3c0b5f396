#include "render/shading.h"

#include <gtest/gtest.h>

#include <limits>

#include "volumes.h"

namespace quincunx {
namespace {

TEST(FacingNormal, IsUnitAndTurnedToTheViewer) {
  const glm::dvec3 along(0.0, 0.0, 1.0);
  EXPECT_EQ(facing_normal({0.0, 0.0, 5.0}, along), glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(facing_normal({0.0, 0.0, -5.0}, along), glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(facing_normal({3.0, 0.0, 0.0}, along), glm::dvec3(1.0, 0.0, 0.0)) << "seen edge-on it stays";
}

TEST(FacingNormal, HoldsForGradientsOfAnySize) {
  const glm::dvec3 along(0.0, 1.0, 0.0);
  for (const double size : {1e-300, 1e-160, 1.0, 1e160, 1e300}) {
    const glm::dvec3 n = facing_normal(size * glm::dvec3(3.0, 4.0, 0.0), along);
    EXPECT_NEAR(n.x, -0.6, 1e-15);
    EXPECT_NEAR(n.y, -0.8, 1e-15);
  }
}

TEST(FacingNormal, WithoutAGradientLooksAtTheViewer) {
  const glm::dvec3 along(0.6, 0.8, 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(facing_normal({0.0, 0.0, 0.0}, along), -along);
  EXPECT_EQ(facing_normal({nan, nan, nan}, along), -along);
  EXPECT_EQ(facing_normal({std::numeric_limits<double>::infinity(), 0.0, 0.0}, along), -along);
}

TEST(Headlight, IsAmbientEdgeOnAndFullHeadOn) {
  const glm::dvec3 color(1.0, 0.5, 0.25), along(0.0, 0.0, 1.0);
  EXPECT_EQ(headlight(color, 0.2, {0.0, 0.0, -1.0}, along), color);
  EXPECT_EQ(headlight(color, 0.2, {1.0, 0.0, 0.0}, along), 0.2 * color);
  EXPECT_NEAR(headlight(color, 0.2, {0.8, 0.0, -0.6}, along).r, 0.2 + 0.8 * 0.6, 1e-15);
}

TEST(Composite, GathersFrontToBack) {
  Composite composite;
  composite.behind({1.0, 0.0, 0.0}, 0.25);
  composite.behind({0.0, 1.0, 0.0}, 0.5);
  EXPECT_EQ(composite.color, glm::dvec3(0.25, 0.75 * 0.5, 0.0));
  EXPECT_EQ(composite.transmittance, 0.375);
  composite.behind({0.0, 0.0, 1.0}, 1.0);
  EXPECT_EQ(composite.color, glm::dvec3(0.25, 0.375, 0.375));
  EXPECT_EQ(composite.transmittance, 0.0);
}

TEST(CentralDifference, OfAQuadraticIsItsGradientInsideAndOneSidedAtTheBorder) {
  // f = x^2 + 3 y: symmetric differences are exact; between 0 and delta the slope of x^2 is delta.
  const QuadraticSpline spline([](const glm::dvec3& u) { return Jet{u.x * u.x + 3.0 * u.y, {2.0 * u.x, 3.0, 0.0}}; });
  const Coefficients<double> c = QuadraticSpline::domain({4, 4, 4}, 100.0);
  EXPECT_EQ(central_difference(spline, c, {2.5, 3.0, 1.0}, 0.5), glm::dvec3(5.0, 3.0, 0.0));
  EXPECT_EQ(central_difference(spline, c, {0.0, 0.25, 7.0}, 0.5), glm::dvec3(0.5, 3.0, 0.0));
  EXPECT_EQ(central_difference(spline, c, {7.0, 7.0, 0.0}, 0.5), glm::dvec3(13.5, 3.0, 0.0));
}

}  // namespace
}  // namespace quincunx

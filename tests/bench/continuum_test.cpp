// What pictures are compared with where the truth is known.
#include "bench/continuum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/camera.h"

namespace quincunx {
namespace {

Scene scene_of(double isovalue, const Camera& camera, int size = 48) {
  Scene scene;
  scene.isosurfaces = {Isosurface{.isovalue = isovalue}};
  scene.width = scene.height = size;
  scene.camera = camera;
  return scene;
}

TEST(FieldContinuum, HitsASphereWhereTheQuadraticDoesWithItsNormal) {
  const auto field = make_field("sphere");  // 0.8^2 - |x|^2
  const Scene scene = scene_of(0.0, {.eye = {2.0, -3.0, 1.0}, .target = {}, .up = {0, 0, 1}, .fov = 40.0});
  const Frame frame = field_continuum(*field, 0.05)->frame(scene);
  const CameraFrame camera = camera_frame(scene.camera, 48, 48);
  int hits = 0;
  for (int j = 0; j < 48; ++j)
    for (int i = 0; i < 48; ++i) {
      const std::size_t p = std::size_t(48 * j + i);
      const glm::dvec3 d = pixel_direction(camera, 48, 48, i, j), o = scene.camera.eye;
      const double b = glm::dot(o, d), q = b * b - glm::dot(o, o) + 0.64;
      ASSERT_EQ(std::isfinite(frame.depth[p]), q > 0.0) << i << " " << j;
      if (q <= 0.0) continue;
      ++hits;
      const double t = -b - std::sqrt(q);
      EXPECT_NEAR(frame.depth[p], t, 1e-6);
      const glm::dvec3 normal = glm::normalize(o + t * d);
      for (int a = 0; a < 3; ++a) EXPECT_NEAR(frame.normal[3 * p + std::size_t(a)], normal[a], 1e-6);
      EXPECT_GT(frame.color[4 * p], 0.1f);
    }
  EXPECT_GT(hits, 300);
}

TEST(FieldContinuum, FindsAPairOfRootsBetweenTwoPlacesItLooksAt) {
  // A sphere of radius 0.05: the ray through its middle is inside it for 0.1, and steps of 0.4 pass over it.
  const auto field = make_field("sphere");
  const double isovalue = 0.64 - 0.0025;
  const Camera camera{.eye = {0.0, -3.0, 0.0}, .target = {}, .up = {0, 0, 1}, .fov = 10.0};
  const Frame frame = field_continuum(*field, 0.4)->frame(scene_of(isovalue, camera, 1));
  EXPECT_NEAR(frame.depth[0], 2.95, 1e-6);
}

TEST(FieldContinuum, IsClippedToTheCubeAndHasNoCaps) {
  // All of the cube but the ball is outside of it; from there on the value is below, so that what is hit is the ball.
  const auto field = make_field("sphere");
  const Camera inside{.eye = {0.0, 0.0, 0.0}, .target = {0, 1, 0}, .up = {0, 0, 1}, .fov = 10.0};
  EXPECT_NEAR(field_continuum(*field, 0.1)->frame(scene_of(0.0, inside, 1)).depth[0], 0.8, 1e-6);
  // Above everywhere in the cube: no surface, though the ray enters above the isovalue.
  const Camera outside{.eye = {0.0, -3.0, 0.0}, .target = {}, .up = {0, 0, 1}, .fov = 10.0};
  EXPECT_FALSE(std::isfinite(field_continuum(*field, 0.1)->frame(scene_of(-5.0, outside, 1)).depth[0]));
}

TEST(SplineContinuum, IsItsSplineInTheWorld) {
  // A tricubic spline reproduces the sphere's quadratic.
  const auto field = make_field("sphere");
  const Volume volume = sample_field(*field, LatticeKind::cartesian, Extents(24));
  const auto spline = spline_continuum(volume, "tricubic", Spline::Prefilter::automatic);
  const glm::dvec3 x(0.3, -0.2, 0.1);
  const Jet jet = spline->at(x);
  EXPECT_NEAR(jet.value, field->value(x), 1e-6);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(jet.gradient[a], field->gradient(x)[a], 1e-5);
  const Camera camera{.eye = {2.0, -3.0, 1.0}, .target = {}, .up = {0, 0, 1}, .fov = 40.0};
  const Frame a = spline->frame(scene_of(0.0, camera)), b = field_continuum(*field, 0.05)->frame(scene_of(0.0, camera));
  int differ = 0;
  for (std::size_t p = 0; p < a.depth.size(); ++p) {
    if (std::isfinite(a.depth[p]) != std::isfinite(b.depth[p])) ++differ;
    if (!std::isfinite(a.depth[p]) || !std::isfinite(b.depth[p])) continue;
    EXPECT_NEAR(a.depth[p], b.depth[p], 1e-4);
  }
  EXPECT_LE(differ, 2);
}

}  // namespace
}  // namespace quincunx

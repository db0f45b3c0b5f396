// Rays that rounding likes to break: along axes and knot planes, through lattice points, from inside, from far away.
#include <gtest/gtest.h>

#include "render/reference.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using DeviceRoundingTest = DeviceTest;

/// A ball of radius 9 about the middle of a volume of 31 cells a side; exact in the spline away from the border.
Volume ball() {
  return bcc_volume({16, 16, 16}, [](const glm::dvec3& u) {
    const glm::dvec3 d = u - glm::dvec3(16.0);
    return 81.0 - glm::dot(d, d);
  });
}

Frame look(const Volume& volume, const Camera& camera, int size, const std::string& structure = "grid", Intersect intersect = Intersect::exact) {
  DeviceRenderer renderer(test_kernels(), volume, {});
  Renderer::Request request = request_for(volume, 0.0, size);
  request.scene.camera = camera;
  request.scene.intersect = intersect;
  request.skip.structure = structure;
  RenderStats stats;
  return renderer.render(request, stats);
}

void expect_all_hit(const Frame& frame) {
  for (std::size_t p = 0; p < frame.depth.size(); ++p) {
    ASSERT_TRUE(std::isfinite(frame.depth[p])) << "pixel " << p;
    for (int a = 0; a < 3; ++a) ASSERT_TRUE(std::isfinite(frame.normal[3 * p + a])) << "pixel " << p;
    for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(frame.color[4 * p + c])) << "pixel " << p;
  }
}

TEST_F(DeviceRoundingTest, RaysAlongAxesAndInKnotPlanesAndThroughLatticePointsHitTheBall) {
  const Volume volume = ball();
  // The middle ray of an odd picture runs exactly along the direction; rows and columns through it lie in planes.
  for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), {0, -1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, -1}, {1, 1, 1}, {-1, 1, 1}, {2, 1, 0}})
    for (const glm::dvec3& through : {glm::dvec3(16, 16, 16), {15, 15, 15}, {16.5, 16.5, 16.5}, {16, 15.5, 16}}) {
      Camera camera;
      camera.target = through;
      camera.eye = through - 60.0 * glm::normalize(d);
      camera.up = std::abs(d.z) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
      camera.fov = 6.0;
      SCOPED_TRACE(testing::Message() << "along " << d.x << " " << d.y << " " << d.z << " through " << through.x << " " << through.y << " " << through.z);
      expect_all_hit(look(volume, camera, 31));
      const Frame frame = look(volume, camera, 31);
      const glm::dvec3 unit = glm::normalize(d), m = camera.eye - glm::dvec3(16.0);
      const double b = glm::dot(m, unit), depth = -b - std::sqrt(b * b - glm::dot(m, m) + 81.0);
      EXPECT_NEAR(frame.depth[15 * 31 + 15], depth, 2e-5);
    }
}

TEST_F(DeviceRoundingTest, RaysInsideAFaceOfTheDomainSeeTheSurfaceThere) {
  const Volume volume = bcc_volume({16, 16, 16}, [](const glm::dvec3& u) { return u.x - 12.0; });
  for (const double z : {0.0, 31.0}) {
    Camera camera;
    camera.target = {16.0, 16.0, z};
    camera.eye = {-40.0, 16.0, z};
    camera.up = {0, 0, 1};
    camera.fov = 2.0;
    const Frame frame = look(volume, camera, 9);
    EXPECT_NEAR(frame.depth[4 * 9 + 4], 52.0, 1e-4) << "z = " << z;
  }
}

TEST_F(DeviceRoundingTest, AnEyeInsideSeesTheBallAllAroundFromWithin) {
  const Volume volume = ball();
  for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {-1, 1, 1}}) {
    Camera camera;
    camera.eye = glm::dvec3(16.0);
    camera.target = camera.eye + d;
    camera.up = std::abs(d.z) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    camera.fov = 100.0;
    const Frame frame = look(volume, camera, 33);
    expect_all_hit(frame);
    for (const float z : frame.depth) EXPECT_NEAR(z, 9.0, 1e-5);
  }
}

TEST_F(DeviceRoundingTest, AnEyeTenThousandVolumeSizesAwaySeesNoHoleAndEveryStructureTheSame) {
  const Volume volume = ball();
  Camera camera;
  camera.target = glm::dvec3(16.0);
  camera.eye = camera.target + 31e4 * glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
  camera.up = {0, 0, 1};
  camera.fov = 2.0 * std::atan(6.0 / 31e4) * 180.0 / M_PI;
  const Frame frame = look(volume, camera, 65);
  expect_all_hit(frame);
  expect_same_picture(frame, look(volume, camera, 65, "none"));
  // Depths there have steps of 2^-5; normals are as good as ever.
  const CameraFrame frame_of = camera_frame(camera, 65, 65);
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) {
      const glm::dvec3 d = pixel_direction(frame_of, 65, 65, i, j), m = camera.eye - glm::dvec3(16.0);
      const double b = glm::dot(m, d);
      const double t = -b - std::sqrt(81.0 - glm::dot(m - b * d, m - b * d));
      const glm::dvec3 n = glm::normalize(m + t * d);
      const std::size_t p = std::size_t(j) * 65 + i;
      EXPECT_NEAR(frame.depth[p], t, 0.02);
      const glm::dvec3 seen(frame.normal[3 * p], frame.normal[3 * p + 1], frame.normal[3 * p + 2]);
      EXPECT_LE(glm::length(seen - n), 1e-5);
    }
}

TEST_F(DeviceRoundingTest, NothingIsSeenBehindTheEyeOrBesideTheVolume) {
  const Volume volume = ball();
  Camera camera;
  camera.eye = {16.0, -40.0, 16.0};
  camera.target = {16.0, -80.0, 16.0};
  camera.up = {0, 0, 1};
  camera.fov = 60.0;
  for (const float z : look(volume, camera, 16).depth) EXPECT_EQ(z, INFINITY);
}

TEST_F(DeviceRoundingTest, ASurfaceAtTheIsovalueEverywhereIsNoSurfaceForAnyStructure) {
  const Volume volume = bcc_volume({8, 8, 8}, [](const glm::dvec3&) { return 0.0; });
  Camera camera;
  camera.eye = {7.0, -40.0, 9.0};
  camera.target = {7.5, 7.5, 7.5};
  camera.up = {0, 0, 1};
  for (const std::string structure : {"none", "grid"})
    for (const float z : look(volume, camera, 16, structure).depth) EXPECT_EQ(z, INFINITY);
}

}  // namespace
}  // namespace quincunx

#include "render/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "lattice/error.h"

namespace quincunx {
namespace {

using ::testing::StartsWith;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

Scene good_scene() {
  Scene scene;
  scene.isosurfaces = {{1.0, {1.0, 0.5, 0.0}, 0.5}, {-3.0, {0.0, 0.0, 1.0}, 1.0}};
  return scene;
}

/// What check_scene says of the good scene after `spoil` changed it.
template <class F>
std::string error_after(F&& spoil) {
  Scene scene = good_scene();
  spoil(scene);
  try {
    check_scene(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckScene, AcceptsGoodScenesAndTheEndsOfRanges) {
  EXPECT_NO_THROW(check_scene(good_scene()));
  EXPECT_EQ(error_after([](Scene& s) { s.isosurfaces[0].opacity = 0.0; }), "");
  EXPECT_EQ(error_after([](Scene& s) { s.ambient = 1.0, s.background = glm::dvec3(1.0); }), "");
  EXPECT_EQ(error_after([](Scene& s) { s.width = 1, s.height = 16384; }), "");
}

TEST(CheckScene, NamesTheFlagOfWhatIsWrong) {
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces.clear(); }), StartsWith("--iso: 0 isovalues"));
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces.resize(255); }), StartsWith("--iso: 255 isovalues"));
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces[1].isovalue = 1.0; }), StartsWith("--iso: 1 stands twice"));
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces[1].isovalue = kNan; }), StartsWith("--iso: nan"));
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces[1].isovalue = kInfinity; }), StartsWith("--iso: inf"));
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces[0].color.g = 1.5; }), StartsWith("--color: 1 1.5 0"));
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces[0].opacity = -0.1; }), StartsWith("--opacity: -0.1"));
  EXPECT_THAT(error_after([](Scene& s) { s.isosurfaces[0].opacity = kNan; }), StartsWith("--opacity: nan"));
  EXPECT_THAT(error_after([](Scene& s) { s.width = 0; }), StartsWith("--size: 0 x 512"));
  EXPECT_THAT(error_after([](Scene& s) { s.height = 16385; }), StartsWith("--size: 512 x 16385"));
  EXPECT_THAT(error_after([](Scene& s) { s.camera.fov = 200.0; }), StartsWith("--camera: fov is 200"));
  EXPECT_THAT(error_after([](Scene& s) { s.background.b = kNan; }), StartsWith("--background: 0 0 nan"));
  EXPECT_THAT(error_after([](Scene& s) { s.ambient = 1.1; }), StartsWith("--ambient: 1.1"));
  EXPECT_THAT(error_after([](Scene& s) { s.step = 0.0; }), StartsWith("--step: 0"));
  EXPECT_THAT(error_after([](Scene& s) { s.step = kInfinity; }), StartsWith("--step: inf"));
  EXPECT_THAT(error_after([](Scene& s) { s.delta = -1.0; }), StartsWith("--delta: -1"));
}

}  // namespace
}  // namespace quincunx

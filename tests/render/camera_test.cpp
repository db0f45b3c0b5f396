#include "render/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "lattice/error.h"

namespace quincunx {
namespace {

using ::testing::HasSubstr;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

/// The message of the InputError that `f` throws; empty where it throws none.
template <class F>
std::string error_of(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Where a world point falls in the image, -1..1 from left to right and from bottom to top.
glm::dvec2 project(const Camera& camera, const CameraFrame& frame, const glm::dvec3& x) {
  const glm::dvec3 d = x - camera.eye;
  const double z = glm::dot(d, frame.forward);
  EXPECT_GT(z, 0.0) << "behind the eye";
  return {glm::dot(d, frame.right) / glm::dot(frame.right, frame.right) / z,
          glm::dot(d, frame.up) / glm::dot(frame.up, frame.up) / z};
}

/// Largest |coordinate| of the domain's corners in the image.
glm::dvec2 reach(const Camera& camera, LatticeKind lattice, const Extents& extents, const World& world, int w, int h) {
  const CameraFrame frame = camera_frame(camera, w, h);
  const glm::dvec3 far(domain_max(lattice, extents));
  glm::dvec2 largest(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 u(corner & 1 ? far.x : 0.0, corner & 2 ? far.y : 0.0, corner & 4 ? far.z : 0.0);
    largest = glm::max(largest, glm::abs(project(camera, frame, world.to_world(u))));
  }
  return largest;
}

std::vector<World> worlds() {
  World plain;
  World left_handed;
  left_handed.axes[0] = {-1.0, 0.0, 0.0};
  World sheared;
  sheared.origin = {100.0, -20.0, 3.0};
  sheared.axes = glm::dmat3(glm::dvec3(0.5, 0.1, 0.0), glm::dvec3(0.3, 0.4, -0.2), glm::dvec3(-0.1, 0.6, 1.5));
  World tiny;
  tiny.axes = glm::dmat3(1e-9);
  return {plain, left_handed, sheared, tiny};
}

TEST(Camera, PixelDirectionsAreThoseOfTheFormulaByHand) {
  // Along +y with z up: f = y, r = y x z = x, v = x x y = z. tan(90/2) = 1, 4 x 2 pixels, W/H = 2.
  const Camera camera{{0.0, -5.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, 90.0};
  const CameraFrame frame = camera_frame(camera, 4, 2);
  expect_near(frame.forward, {0.0, 1.0, 0.0}, 1e-15);
  expect_near(frame.right, {2.0, 0.0, 0.0}, 1e-15);
  expect_near(frame.up, {0.0, 0.0, 1.0}, 1e-15);
  // Top left: x = 2(.5)/4 - 1 = -3/4, times 2; y = 1 - 2(.5)/2 = 1/2.
  expect_near(pixel_direction(frame, 4, 2, 0, 0), glm::normalize(glm::dvec3(-1.5, 1.0, 0.5)), 1e-15);
  expect_near(pixel_direction(frame, 4, 2, 3, 1), glm::normalize(glm::dvec3(1.5, 1.0, -0.5)), 1e-15);
  // An odd image has a pixel in its middle.
  expect_near(pixel_direction(camera_frame(camera, 5, 3), 5, 3, 2, 1), {0.0, 1.0, 0.0}, 1e-15);
}

TEST(Camera, UpNeedNotBeUnitNorPerpendicular) {
  const Camera a{{1.0, 2.0, 3.0}, {-4.0, 0.5, 2.0}, {0.0, 0.0, 1.0}, 40.0};
  Camera b = a;
  b.up = glm::dvec3(0.0, 0.0, 1e-200) + 1e-200 * (a.target - a.eye);
  const CameraFrame fa = camera_frame(a, 7, 5), fb = camera_frame(b, 7, 5);
  expect_near(fa.right, fb.right, 1e-14);
  expect_near(fa.up, fb.up, 1e-14);
  EXPECT_NEAR(glm::dot(fa.up, fa.forward), 0.0, 1e-15);
}

TEST(Camera, ACameraThatSeesNothingIsAnErrorThatNamesIt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto frame = [](const Camera& c) { return error_of([&] { camera_frame(c, 4, 4, "view.json"); }); };
  EXPECT_THAT(frame({{1, 1, 1}, {1, 1, 1}, {0, 0, 1}, 30}), HasSubstr("view.json: eye and target are both 1 1 1"));
  EXPECT_THAT(frame({{0, 0, 5}, {0, 0, 0}, {0, 0, -2}, 30}), HasSubstr("view.json: up is 0 0 -2"));
  EXPECT_THAT(frame({{0, 0, 5}, {0, 0, 0}, {0, 0, 0}, 30}), HasSubstr("view.json: up is 0 0 0"));
  EXPECT_THAT(frame({{0, 0, nan}, {0, 0, 0}, {0, 1, 0}, 30}), HasSubstr("view.json: eye is 0 0 nan"));
  EXPECT_THAT(frame({{1e308, 0, 0}, {-1e308, 0, 0}, {0, 1, 0}, 30}), HasSubstr("too far apart"));
  for (const double fov : {0.0, -3.0, 180.0, 1e9, nan})
    EXPECT_THAT(frame({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, fov}), HasSubstr("view.json: fov is"));
  EXPECT_THAT(error_of([&] { camera_frame(Camera{}, 0, 4); }), HasSubstr("camera: image size is 0 x 4"));
}

TEST(FramingCamera, ShowsTheWholeDomainAndFillsTheImage) {
  for (const World& world : worlds())
    for (const auto& size : {glm::ivec2(512, 512), glm::ivec2(640, 200), glm::ivec2(100, 400)})
      for (double elevation = -90.0; elevation <= 90.0; elevation += 15.0)
        for (double azimuth = -180.0; azimuth <= 400.0; azimuth += 29.0) {
          const Extents extents(20, 30, 15);
          const Camera camera = framing_camera(LatticeKind::bcc, extents, world, {azimuth, elevation, 1.0}, size.x, size.y);
          const glm::dvec2 r = reach(camera, LatticeKind::bcc, extents, world, size.x, size.y);
          EXPECT_LT(std::max(r.x, r.y), 0.96);
          EXPECT_GT(std::max(r.x, r.y), 0.6) << "azimuth " << azimuth << " elevation " << elevation;
        }
}

TEST(FramingCamera, KeepsTheConventionsOfAzimuthElevationAndUp) {
  const Extents extents(8, 8, 8);
  const auto view = [&](double azimuth, double elevation) {
    return camera_frame(framing_camera(LatticeKind::bcc, extents, World{}, {azimuth, elevation, 1.0}, 9, 9), 9, 9);
  };
  expect_near(view(0, 0).forward, {0, 1, 0}, 1e-12);
  expect_near(view(90, 0).forward, {-1, 0, 0}, 1e-12);
  expect_near(glm::normalize(view(0, 0).up), {0, 0, 1}, 1e-12);
  EXPECT_GT(view(30, 40).up.z, 0.0);
  EXPECT_LT(view(30, 40).forward.z, 0.0) << "elevation 40 looks down";
  // From straight above and below, the image is the limit of the views nearby.
  for (const double elevation : {-90.0, 90.0}) {
    const CameraFrame pole = view(30, elevation), near = view(30, elevation * (1.0 - 1e-9));
    expect_near(pole.right, near.right, 1e-6);
    expect_near(pole.up, near.up, 1e-6);
  }
}

TEST(FramingCamera, HasZAtTheTopOfTheImageInALeftHandedWorldToo) {
  for (const World& world : worlds()) {
    const Camera camera = framing_camera(LatticeKind::bcc, {8, 8, 8}, world, {25.0, 15.0, 1.0}, 64, 64);
    const CameraFrame frame = camera_frame(camera, 64, 64);
    EXPECT_GT(pixel_direction(frame, 64, 64, 32, 0).z, pixel_direction(frame, 64, 64, 32, 63).z);
  }
}

TEST(FramingCamera, ZoomNarrowsTheFieldOfViewByItsFactor) {
  const Extents extents(10, 10, 10);
  const Camera one = framing_camera(LatticeKind::bcc, extents, World{}, {30.0, 20.0, 1.0}, 50, 50);
  const Camera three = framing_camera(LatticeKind::bcc, extents, World{}, {30.0, 20.0, 3.0}, 50, 50);
  EXPECT_EQ(one.eye, three.eye);
  const glm::dvec2 a = reach(one, LatticeKind::bcc, extents, World{}, 50, 50);
  const glm::dvec2 b = reach(three, LatticeKind::bcc, extents, World{}, 50, 50);
  EXPECT_NEAR(b.x, 3.0 * a.x, 1e-12);
  EXPECT_NEAR(b.y, 3.0 * a.y, 1e-12);
}

TEST(FramingCamera, NeedlesPlatesAndSinglePointsAreSeenFromOutside) {
  for (const Extents& extents : {Extents(1, 1, 200), Extents(300, 300, 1), Extents(1, 1, 1), Extents(1, 64, 64)})
    for (const LatticeKind lattice : {LatticeKind::bcc, LatticeKind::cartesian})
      for (const double elevation : {-90.0, 0.0, 37.0, 90.0})
        for (const double azimuth : {0.0, 90.0, 123.0}) {
          const Camera camera = framing_camera(lattice, extents, World{}, {azimuth, elevation, 1.0}, 64, 48);
          const glm::dvec2 r = reach(camera, lattice, extents, World{}, 64, 48);
          EXPECT_LT(std::max(r.x, r.y), 0.96);
        }
}

TEST(FramingCamera, NumbersOutOfRangeAreErrorsThatNameTheFlag) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto frame = [](const Orbit& orbit) {
    return error_of([&] { framing_camera(LatticeKind::bcc, {8, 8, 8}, World{}, orbit, 8, 8); });
  };
  EXPECT_THAT(frame({nan, 0, 1}), HasSubstr("--azimuth: nan"));
  EXPECT_THAT(frame({0, 91, 1}), HasSubstr("--elevation: 91"));
  EXPECT_THAT(frame({0, nan, 1}), HasSubstr("--elevation: nan"));
  EXPECT_THAT(frame({0, 0, 0}), HasSubstr("--zoom: 0"));
  EXPECT_THAT(frame({0, 0, nan}), HasSubstr("--zoom: nan"));
}

class CameraFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string error(const std::string& text) {
    return error_of([&] { read_camera(write(text)); });
  }
  const std::string path_ =
      ::testing::TempDir() + "quincunx_" + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
};

TEST_F(CameraFile, HoldsEyeTargetUpAndFov) {
  const Camera camera = read_camera(write(R"({"eye":[1,2.5,-3e2],"target":[0,0,0],"up":[0,0,1],"fov":45})"));
  EXPECT_EQ(camera.eye, glm::dvec3(1.0, 2.5, -300.0));
  EXPECT_EQ(camera.target, glm::dvec3(0.0));
  EXPECT_EQ(camera.up, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(camera.fov, 45.0);
}

TEST_F(CameraFile, MayLeaveOutUpAndFov) {
  const Camera camera = read_camera(write(R"({"target":[0,0,0],"eye":[1,2,3]})"));
  EXPECT_EQ(camera.up, Camera{}.up);
  EXPECT_EQ(camera.fov, Camera{}.fov);
}

TEST_F(CameraFile, ErrorsNameTheFileAndTheKey) {
  const std::string eye = R"("eye":[1,2,3])", target = R"("target":[0,0,0])";
  EXPECT_THAT(error("{" + eye + "}"), HasSubstr(path_ + ": key \"target\" is missing"));
  EXPECT_THAT(error("{" + target + "}"), HasSubstr("key \"eye\" is missing"));
  EXPECT_THAT(error("{" + eye + "," + target + R"(,"zoom":2})"), HasSubstr("unknown key \"zoom\""));
  EXPECT_THAT(error("{" + eye + "," + eye + "," + target + "}"), HasSubstr("key \"eye\" stands twice"));
  EXPECT_THAT(error("{" + target + R"(,"eye":[1,2]})"), HasSubstr("\"eye\" is [1,2]; expected [x, y, z]"));
  EXPECT_THAT(error("{" + target + R"(,"eye":[1,2,"3"]})"), HasSubstr("\"eye\" holds \"3\""));
  EXPECT_THAT(error("{" + target + R"(,"eye":{"x":1}})"), HasSubstr("\"eye\" is {\"x\":1}"));
  EXPECT_THAT(error("{" + eye + "," + target + R"(,"fov":true})"), HasSubstr("\"fov\" holds true"));
  EXPECT_THAT(error("{" + eye + "," + target + R"(,"fov":180})"), HasSubstr(path_ + ": fov is 180"));
  EXPECT_THAT(error("{" + eye + "," + target + R"(,"fov":1e999})"), HasSubstr(path_ + ": not JSON"));
  EXPECT_THAT(error("[1,2]"), HasSubstr("a JSON array; expected an object"));
  EXPECT_THAT(error(""), HasSubstr(path_ + ": not JSON"));
  EXPECT_THAT(error_of([] { read_camera("/nowhere/c.json"); }), HasSubstr("/nowhere/c.json: cannot be opened"));
  EXPECT_THAT(error_of([] { read_camera("/tmp"); }), HasSubstr("/tmp: a folder"));
}

TEST_F(CameraFile, CutAnywhereIsAnErrorOfOneLine) {
  const std::string whole = R"({"eye":[1,2,3],"target":[0,0,0]})";
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::string message = error(whole.substr(0, n));
    EXPECT_THAT(message, HasSubstr(path_)) << n;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace quincunx

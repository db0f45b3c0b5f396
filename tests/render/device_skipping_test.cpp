// No structure changes a pixel: every picture equals that of `none`, bit for bit.
#include <gtest/gtest.h>

#include "accel/structure.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using DeviceSkippingTest = DeviceTest;

struct Case {
  std::string name;
  Volume volume;
  double isovalue;
};

/// Volumes that a careless bound or walk gets wrong.
std::vector<Case> adversarial_volumes() {
  const auto parity = [](const glm::dvec3& u) { return int(u.x + u.y + u.z) / 2 & 1 ? 1.0 : 0.0; };
  const auto spike = [](const glm::dvec3& u) { return u == glm::dvec3(8, 10, 6) ? 1e6 : 1.0; };
  const auto sheet = [](const glm::dvec3& u) { return std::exp(-0.5 * std::pow(u.x + u.y - u.z - 10.0, 2.0)); };
  const auto ramp = [](const glm::dvec3& u) { return u.x - 8.0; };  // a knot plane is the surface
  const auto step = [](const glm::dvec3& u) { return u.z < 9.0 ? 0.0 : 1.0; };
  std::vector<Case> cases;
  cases.push_back({"noise", random_volume({11, 9, 13}, 3), 0.5});
  cases.push_back({"checkerboard", bcc_volume({8, 8, 8}, parity), 0.5});
  cases.push_back({"spike", bcc_volume({9, 9, 9}, spike), 2.0});
  cases.push_back({"diagonal sheet", bcc_volume({10, 10, 10}, sheet), 0.6});
  cases.push_back({"ramp through lattice points", bcc_volume({9, 9, 9}, ramp), 0.0});
  cases.push_back({"step", bcc_volume({9, 9, 9}, step), 0.5});
  cases.push_back({"constant above", bcc_volume({5, 5, 5}, [](const glm::dvec3&) { return 1.0; }), 0.5});
  cases.push_back({"constant at the isovalue", bcc_volume({5, 5, 5}, [](const glm::dvec3&) { return 0.5; }), 0.5});
  cases.push_back({"constant below", bcc_volume({5, 5, 5}, [](const glm::dvec3&) { return 0.0; }), 0.5});
  cases.push_back({"one by one by many", random_volume({1, 1, 40}, 4), 0.5});
  cases.push_back({"one sample a coset", random_volume({1, 1, 1}, 6), 0.5});
  return cases;
}

class EverySetting : public DeviceTest {
 protected:
  /// Compares every structure, block size and cell test with none, from `views` directions and from inside.
  void compare_all(const Case& c, Intersect intersect, bool several) {
    DeviceRenderer renderer(test_kernels(), c.volume, {});
    RenderStats stats;
    for (int view = 0; view < 3; ++view) {
      Renderer::Request request = request_for(c.volume, c.isovalue, 32, 30.0 + 120.0 * view, 75.0 - 60.0 * view);
      if (view == 2) {
        request.scene.camera.eye = 0.97 * request.scene.camera.target + 0.03 * request.scene.camera.eye;
        request.scene.camera.fov = 80.0;
      }
      request.scene.intersect = intersect;
      request.scene.step = 0.7;
      if (several) request.scene.isosurfaces = {{c.isovalue, {1, 0, 0}, 0.5}, {0.8 * c.isovalue + 0.05, {0, 1, 0}, 0.5}};
      request.skip.structure = "none";
      const Frame truth = renderer.render(request, stats);
      for (const std::string_view structure : structure_names()) {
        if (structure == "none") continue;
        for (const int block : {1, 4, 16})
          for (const bool cell_test : {false, true}) {
            request.skip = {std::string(structure), block, cell_test};
            SCOPED_TRACE(c.name + ", " + request.skip.structure + ", block " + std::to_string(block) + ", view " +
                         std::to_string(view) + (cell_test ? ", cells tested" : ""));
            expect_same_picture(renderer.render(request, stats), truth);
          }
      }
    }
  }
};

TEST_F(EverySetting, ShowsTheFirstRootsThatNoneShows) {
  for (const Case& c : adversarial_volumes()) compare_all(c, Intersect::exact, false);
}

TEST_F(EverySetting, ShowsTheSurfacesBehindEachOtherThatNoneShows) {
  for (const Case& c : adversarial_volumes()) compare_all(c, Intersect::exact, true);
}

TEST_F(EverySetting, ShowsTheMarchedLayersThatNoneShowsEvenWhereSamplesMissOne) {
  // Layers thinner than a step: what a skipped block knows of them must not reach the samples.
  const auto layers = [](const glm::dvec3& u) { return std::sin(2.2 * u.x) + 0.5 * std::sin(1.7 * u.y + 0.9 * u.z); };
  compare_all({"layers", bcc_volume({12, 12, 12}, layers), 0.5}, Intersect::march, true);
  compare_all({"noise", random_volume({12, 12, 12}, 9), 0.7}, Intersect::march, true);
}

TEST_F(EverySetting, ShowsTheMarchedSamplesThatNoneShows) {
  for (const Case& c : adversarial_volumes()) compare_all(c, Intersect::march, false);
}

}  // namespace
}  // namespace quincunx

// No structure changes a pixel: every picture equals that of `none`, bit for bit.
#include <gtest/gtest.h>

#include "accel/structure.h"
#include "tests/render/adversarial_volumes.h"
#include "tests/render/device_fixture.h"
#include "tests/render/skip_property.h"

namespace quincunx {
namespace {

/// Every way to skip but none.
std::vector<std::string_view> skipping_labels() {
  std::vector<std::string_view> labels = skip_labels();
  std::erase(labels, "none");
  return labels;
}

class EverySetting : public DeviceTest {
 protected:
  /// A request for the n-th view of `c`; the last of three is from inside.
  static Renderer::Request view_of(const AdversarialVolume& c, int view, int size) {
    Renderer::Request request = request_for(c.volume, c.isovalue, size, 30.0 + 120.0 * view, 75.0 - 60.0 * view);
    if (view == 2) {
      request.scene.camera.eye = 0.97 * request.scene.camera.target + 0.03 * request.scene.camera.eye;
      request.scene.camera.fov = 80.0;
    }
    return request;
  }

  /// Compares every structure with none, block by block, with and without the cell test in turns.
  void compare_all(const AdversarialVolume& c, const Renderer::Request& view, const std::vector<int>& blocks) {
    bool cell_test = false;
    DeviceRenderer renderer(test_kernels(), c.volume, {});
    RenderStats stats;
    Renderer::Request request = view;
    request.skip.structure = "none";
    const Frame truth = renderer.render(request, stats);
    for (const int block : blocks) {
      cell_test = !cell_test;  // each label, an even number of them, has both
      for (const std::string_view label : skipping_labels()) {
        cell_test = !cell_test;
        request.skip = labelled_skip(label, {.block = block, .cell_test = cell_test});
        SCOPED_TRACE(c.name + ", " + std::string(label) + ", block " + std::to_string(block) + (cell_test ? ", cells tested" : ""));
        expect_same_picture(renderer.render(request, stats), truth);
      }
    }
  }
};

TEST_F(EverySetting, ShowsTheFirstRootsThatNoneShows) {
  int view = 0;
  for (const AdversarialVolume& c : adversarial_volumes()) compare_all(c, view_of(c, view++ % 3, 24), {2, 4, 8, 16, 32, 64});
}

TEST_F(EverySetting, ShowsTheSurfacesBehindEachOtherThatNoneShows) {
  int view = 1;
  for (const AdversarialVolume& c : adversarial_volumes()) {
    Renderer::Request request = view_of(c, view++ % 3, 16);
    request.scene.isosurfaces = {{c.isovalue, {1, 0, 0}, 0.5}, {0.8 * c.isovalue + 0.05, {0, 1, 0}, 0.5}};
    compare_all(c, request, {2, 8});
  }
}

TEST_F(EverySetting, ShowsTheMarchedSamplesThatNoneShows) {
  int view = 2;
  for (const AdversarialVolume& c : adversarial_volumes()) {
    Renderer::Request request = view_of(c, view++ % 3, 16);
    request.scene.intersect = Intersect::march;
    request.scene.step = 0.7;
    compare_all(c, request, {1, 8});
  }
}

TEST_F(EverySetting, ShowsTheMarchedLayersThatNoneShowsEvenWhereSamplesMissOne) {
  // Layers thinner than a step: what a skipped block knows of them must not reach the samples.
  const auto layers = [](const glm::dvec3& u) { return std::sin(2.2 * u.x) + 0.5 * std::sin(1.7 * u.y + 0.9 * u.z); };
  for (const AdversarialVolume& c : {AdversarialVolume{"layers", bcc_volume({12, 12, 12}, layers), 0.5}, {"noise", random_volume({12, 12, 12}, 9), 0.7}})
    for (const int view : {0, 1, 2}) {
      Renderer::Request request = view_of(c, view, 32);
      request.scene.intersect = Intersect::march;
      request.scene.step = 0.7;
      request.scene.isosurfaces.push_back({0.8 * c.isovalue + 0.05, {0, 1, 0}, 0.5});
      request.scene.isosurfaces.front().opacity = 0.5;
      compare_all(c, request, {2, 8});
    }
}

TEST_F(EverySetting, ShowsManySurfacesAtOnceAsNoneDoes) {
  const AdversarialVolume c{"noise", random_volume({9, 8, 10}, 12), 0.5};
  Renderer::Request request = view_of(c, 0, 32);
  request.scene.isosurfaces.clear();
  for (int k = 0; k < 40; ++k) request.scene.isosurfaces.push_back({0.2 + 0.02 * k, {1.0, 0.02 * k, 0.5}, 0.3});
  compare_all(c, request, {2, 8});
}

TEST_F(EverySetting, HoldsNoPointOfTheSurfaceInWhatItSkips) {
  SkippedSpace all;
  std::uint32_t seed = 1;
  for (const std::string_view label : skipping_labels()) {
    SkippedSpace seen;
    for (const AdversarialVolume& v : adversarial_volumes()) {
      const SkipConfig config = labelled_skip(label, {.block = 1 << seed % 4, .cell_test = seed / 4 % 2 == 1});
      seen += look_into_skipped_space(v, config, 8192, seed++);
    }
    EXPECT_EQ(seen.violations, 0u) << label;
    EXPECT_GT(seen.stretches, seen.rays / 2) << label;
    all += seen;
  }
  std::printf("%llu rays, %llu points of %llu skipped stretches; seeds 1 to %u\n", static_cast<unsigned long long>(all.rays),
              static_cast<unsigned long long>(all.points), static_cast<unsigned long long>(all.stretches), seed - 1);
}

TEST_F(EverySetting, IsCaughtWhereItsBoundsAreTooNarrow) {
  // What the test above would say of a structure that believes a tenth too little.
  for (const std::string_view label : skipping_labels()) {
    SkippedSpace seen;
    std::uint32_t seed = 1;
    for (const AdversarialVolume& v : adversarial_volumes())
      seen += look_into_skipped_space(v, labelled_skip(label, {.block = 2, .cell_test = false}), 4096, seed++, 0.1);
    EXPECT_GT(seen.violations, 0u) << label;
  }
}

}  // namespace
}  // namespace quincunx

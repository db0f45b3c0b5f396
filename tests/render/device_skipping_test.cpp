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

  /// A volume and a request for it, without how to skip.
  struct Scenery {
    std::string name;
    Volume volume;
    Renderer::Request request;
  };

  /// Compares every structure with none, block by block, with and without the cell test in turns. Kernels are changed as rarely as
  /// can be: drivers forget those that they have not used for a while.
  void compare_all(const std::vector<Scenery>& sceneries, const std::vector<int>& blocks) {
    std::vector<std::unique_ptr<DeviceRenderer>> renderers;
    std::vector<Frame> truths;
    RenderStats stats;
    for (const Scenery& s : sceneries) {
      renderers.push_back(std::make_unique<DeviceRenderer>(test_kernels(), s.volume, Renderer::Config{}));
      Renderer::Request request = s.request;
      request.skip.structure = "none";
      truths.push_back(renderers.back()->render(request, stats));
    }
    for (const std::string_view label : skipping_labels())
      for (const bool cell_test : {false, true})
        for (std::size_t n = 0; n < sceneries.size(); ++n)
          for (std::size_t b = cell_test == (n % 2 == 0); b < blocks.size(); b += 2) {
            Renderer::Request request = sceneries[n].request;
            request.skip = labelled_skip(label, {.block = blocks[b], .cell_test = cell_test});
            SCOPED_TRACE(sceneries[n].name + ", " + std::string(label) + ", block " + std::to_string(blocks[b]) + (cell_test ? ", cells tested" : ""));
            expect_same_picture(renderers[n]->render(request, stats), truths[n]);
          }
  }
};

TEST_F(EverySetting, ShowsTheFirstRootsThatNoneShows) {
  std::vector<Scenery> all;
  for (const AdversarialVolume& c : adversarial_volumes()) all.push_back({c.name, c.volume, view_of(c, int(all.size()) % 3, 24)});
  compare_all(all, {2, 4, 8, 16, 32, 64});
}

TEST_F(EverySetting, ShowsTheSurfacesBehindEachOtherThatNoneShows) {
  std::vector<Scenery> all;
  for (const AdversarialVolume& c : adversarial_volumes()) {
    Renderer::Request request = view_of(c, int(all.size() + 1) % 3, 20);
    request.scene.isosurfaces = {{c.isovalue, {1, 0, 0}, 0.5}, {0.8 * c.isovalue + 0.05, {0, 1, 0}, 0.5}};
    all.push_back({c.name, c.volume, request});
  }
  compare_all(all, {1, 4, 2, 16});
}

TEST_F(EverySetting, ShowsTheMarchedSamplesThatNoneShows) {
  std::vector<Scenery> all;
  for (const AdversarialVolume& c : adversarial_volumes()) {
    Renderer::Request request = view_of(c, int(all.size() + 2) % 3, 24);
    request.scene.intersect = Intersect::march;
    request.scene.step = 0.7;
    all.push_back({c.name, c.volume, request});
  }
  compare_all(all, {1, 4, 2, 16});
}

TEST_F(EverySetting, ShowsTheMarchedLayersThatNoneShowsEvenWhereSamplesMissOne) {
  // Layers thinner than a step: what a skipped block knows of them must not reach the samples.
  const auto layers = [](const glm::dvec3& u) { return std::sin(2.2 * u.x) + 0.5 * std::sin(1.7 * u.y + 0.9 * u.z); };
  std::vector<Scenery> all;
  for (const AdversarialVolume& c : {AdversarialVolume{"layers", bcc_volume({12, 12, 12}, layers), 0.5}, {"noise", random_volume({12, 12, 12}, 9), 0.7}})
    for (const int view : {0, 1, 2}) {
      Renderer::Request request = view_of(c, view, 32);
      request.scene.intersect = Intersect::march;
      request.scene.step = 0.7;
      request.scene.isosurfaces.push_back({0.8 * c.isovalue + 0.05, {0, 1, 0}, 0.5});
      request.scene.isosurfaces.front().opacity = 0.5;
      all.push_back({c.name, c.volume, request});
    }
  compare_all(all, {1, 4, 2, 16});
}

TEST_F(EverySetting, ShowsManySurfacesAtOnceAsNoneDoes) {
  const AdversarialVolume c{"noise", random_volume({9, 8, 10}, 12), 0.5};
  Renderer::Request request = view_of(c, 0, 32);
  request.scene.isosurfaces.clear();
  for (int k = 0; k < 40; ++k) request.scene.isosurfaces.push_back({0.2 + 0.02 * k, {1.0, 0.02 * k, 0.5}, 0.3});
  compare_all({{c.name, c.volume, request}}, {2, 8});
}

TEST_F(EverySetting, ShowsTheSamePictureHoweverRangesAreLookedFor) {
  std::uint64_t more = 0;
  for (const AdversarialVolume& c : adversarial_volumes()) {
    Renderer::Request request = view_of(c, 0, 16);
    DeviceRenderer renderer(test_kernels(), c.volume, Renderer::Config{});
    RenderStats stats;
    request.skip.structure = "none";
    const Frame truth = renderer.render(request, stats);
    std::vector<std::uint64_t> blocks, cells;
    for (const RangeQueryKind query : {RangeQueryKind::intervals, RangeQueryKind::table, RangeQueryKind::irt, RangeQueryKind::intervals}) {
      SCOPED_TRACE(c.name + ", query " + std::to_string(int(query)));
      request.skip = {.structure = "grid", .block = 2, .range_query = query};
      expect_same_picture(renderer.render(request, stats), truth);
      blocks.push_back(stats.active_blocks);
      cells.push_back(stats.active_cells);
    }
    for (const std::vector<std::uint64_t>& active : {blocks, cells}) {
      EXPECT_GE(active[1], active[0]) << "by entries";
      more += active[1] - active[0];
      EXPECT_EQ(active[2], active[1]);
      EXPECT_EQ(active[3], active[0]) << "nothing is left of the query before";
    }
  }
  EXPECT_GT(more, 0u) << "the queries were asked";
}

TEST_F(EverySetting, HoldsNoPointOfTheSurfaceInWhatItSkips) {
  SkippedSpace all;
  std::uint32_t seed = 1;
  for (const std::string_view label : skipping_labels()) {
    SkippedSpace seen;
    for (const bool cell_test : {false, true})
      for (const AdversarialVolume& v : adversarial_volumes())
        seen += look_into_skipped_space(v, labelled_skip(label, {.block = 1 << seed % 4, .cell_test = cell_test}), 4096, seed++);
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

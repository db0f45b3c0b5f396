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
    std::string spline = {};
  };

  /// Compares every structure with none, block by block, with and without the cell test in turns. Kernels are changed as rarely as
  /// can be: drivers forget those that they have not used for a while.
  void compare_all(const std::vector<Scenery>& sceneries, const std::vector<int>& blocks) {
    std::vector<std::unique_ptr<DeviceRenderer>> renderers;
    std::vector<Frame> truths;
    RenderStats stats;
    for (const Scenery& s : sceneries) {
      Renderer::Config config;
      config.spline = s.spline;
      renderers.push_back(std::make_unique<DeviceRenderer>(test_kernels(), s.volume, config));
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

TEST_F(EverySetting, ComparesWithWhatIsSeenNowWhereTheSameBlocksStayActive) {
  // Isovalues on both sides of each border of blocks, closer to each other than the entries of the published queries, which find the same blocks
  // active for several of them.
  const Volume ramp = bcc_volume({16, 6, 6}, [](const glm::dvec3& u) { return u.x; });
  DeviceRenderer renderer(test_kernels(), ramp, Renderer::Config{});
  RenderStats stats;
  std::vector<Renderer::Request> requests;
  std::vector<Frame> truths;
  for (int border = 4; border <= 28; border += 4)
    for (int n = -4; n <= 4; ++n) {
      requests.push_back(request_for(ramp, border + 0.002 * n, 8, 200.0));
      requests.back().skip.structure = "none";
      truths.push_back(renderer.render(requests.back(), stats));
    }
  for (const std::string_view label : skipping_labels())
    for (std::size_t n = 0; n < requests.size(); ++n) {
      SCOPED_TRACE(std::string(label) + ", isovalue " + std::to_string(requests[n].scene.isosurfaces.front().isovalue));
      requests[n].skip = labelled_skip(label, {.block = 4, .cell_test = false});
      requests[n].skip.range_query = RangeQueryKind::table;
      expect_same_picture(renderer.render(requests[n], stats), truths[n]);
    }
}

/// A Cartesian volume of a BCC volume's samples: its cosets, one behind the other along z, or the first alone.
Volume cartesian_twin(const Volume& bcc, bool both) {
  Volume volume = bcc;
  volume.lattice = LatticeKind::cartesian;
  auto& samples = std::get<std::vector<float>>(volume.samples);
  if (both)
    volume.extents.z *= 2;
  else
    samples.resize(samples.size() / 2);
  return volume;
}

/// Opacity in narrow stretches of values, apart from each other, about an isovalue; at the ends too; or nowhere.
DirectVolume narrow_look(double isovalue, int kind) {
  const double width = std::max(std::abs(isovalue), 0.4);
  std::vector<TransferFunction::OpacityPoint> points;
  const auto peak = [&](double at, double half, double opacity) {
    const double value = isovalue + at * width;
    points.insert(points.end(), {{value - half * width, 0.0}, {value, opacity}, {value + half * width, 0.0}});
  };
  if (kind == 1) points = {{isovalue - 1.1 * width, 0.3}, {isovalue - 0.9 * width, 0.0}};
  if (kind != 1) peak(-0.7, 0.02, 0.5);
  peak(-0.25, 0.01, 0.8);
  peak(0.0, 0.015, 0.9);
  peak(0.1, 0.004, 0.4);
  if (kind != 1) peak(0.6, 0.03, 0.3);
  if (kind == 1) points.insert(points.end(), {{isovalue + 0.5 * width, 0.0}, {isovalue + 0.8 * width, 0.2}});
  if (kind == 2)
    for (auto& point : points) point.opacity = 0.0;
  DirectVolume volume;
  volume.function.colors = {{isovalue - width, {1.0, 0.4, 0.1}}, {isovalue, {0.2, 1.0, 0.3}}, {isovalue + width, {0.2, 0.4, 1.0}}};
  volume.function.opacities = points;
  volume.step = 0.6;
  volume.termination = 1.0 / 4096;
  return volume;
}

/// How the volume is shown, in turns with every volume: post, pre-integrated, adaptive; and lit, modulated, jittered.
void choose_look(DirectVolume& volume, Classify classify, bool adaptive, bool other) {
  volume.classify = classify;
  volume.entries = classify == Classify::post ? 1024 : 96;
  volume.adaptive = adaptive;
  volume.finest = 0.02;
  volume.shade = !other;
  if (other) volume.modulate_to = 0.3, volume.jitter = 5;
}

class EveryVolume : public EverySetting {
 protected:
  /// Every adversarial volume, of Cartesian ones every other, the n-th seen from the n-th of three views, with opacity inside or at the
  /// ends, or, of every seventh, none.
  static std::vector<Scenery> volumes(std::string_view spline, Classify classify, bool adaptive, bool other, bool surfaces) {
    std::vector<Scenery> all;
    const std::vector<AdversarialVolume> volumes = adversarial_volumes();
    const bool bcc = spline == "bcc7";
    for (int n = 0; n < int(volumes.size()); n += bcc ? 1 : 2) {
      const AdversarialVolume& c = volumes[std::size_t(n)];
      Renderer::Request request = view_of(c, n % 3, 16);
      request.scene.volume = narrow_look(c.isovalue, n % 7 == 6 ? 2 : n / 2 % 2);
      choose_look(*request.scene.volume, classify, adaptive, other);
      request.scene.isosurfaces.clear();
      const double between = std::max(std::abs(c.isovalue), 0.4);
      if (surfaces) request.scene.isosurfaces = {{c.isovalue + 0.3 * between, {1, 1, 0}, 0.4}, {c.isovalue - 0.4 * between, {0, 1, 1}, 1.0}};
      const Volume volume = bcc ? c.volume : cartesian_twin(c.volume, n % 4 == 0);
      request.scene.camera = framing_camera(volume.lattice, volume.extents, volume.world, {30.0 + 120.0 * (n % 3), 75.0 - 60.0 * (n % 3), 1.0}, 16, 16);
      if (n % 3 == 2) request.scene.camera.eye = 0.8 * request.scene.camera.target + 0.2 * request.scene.camera.eye;
      all.push_back({c.name + " for " + std::string(spline), volume, request, std::string(spline)});
    }
    return all;
  }
};

TEST_F(EveryVolume, ShowsTheClassifiedSamplesThatNoneShows) {
  compare_all(volumes("bcc7", Classify::post, false, false, false), {2, 4, 8, 32});
  compare_all(volumes("trilinear", Classify::post, false, true, false), {2, 8});
}

TEST_F(EveryVolume, ShowsThePreIntegratedStretchesThatNoneShows) {
  compare_all(volumes("bcc7", Classify::pre_integrated, false, true, false), {1, 16, 2, 8});
  compare_all(volumes("trilinear", Classify::pre_integrated, false, false, false), {2, 8});
}

TEST_F(EveryVolume, ShowsTheAdaptiveStepsThatNoneShows) {
  compare_all(volumes("bcc7", Classify::post, true, false, false), {4, 2});
  compare_all(volumes("tricubic", Classify::post, true, true, false), {2, 8});
}

TEST_F(EveryVolume, ShowsWhatNoneShowsTogetherWithTrilinearSurfaces) { compare_all(volumes("trilinear", Classify::post, true, false, true), {2, 8}); }

// Their kernels take long to compile: label long.
using EveryVolumeAtLength = EveryVolume;
TEST_F(EveryVolumeAtLength, ShowsWhatNoneShowsTogetherWithSurfacesOfBcc7) { compare_all(volumes("bcc7", Classify::pre_integrated, false, false, true), {1, 4}); }

TEST_F(EveryVolumeAtLength, ShowsWhatNoneShowsTogetherWithTricubicSurfaces) { compare_all(volumes("tricubic", Classify::post, false, true, true), {4, 2}); }

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

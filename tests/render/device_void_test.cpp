// Void cells on the device: against the reference, against the extended volume, and every way to skip against none, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "accel/structure.h"
#include "lattice/error.h"
#include "render/reference_renderer.h"
#include "render/void_stretches.h"
#include "tests/render/device_fixture.h"
#include "tests/render/void_volumes.h"

namespace quincunx {
namespace {

constexpr NanPolicy kEmpty{NanPolicy::Kind::empty, 0.0};

/// Two stretches of values with opacity.
DirectVolume look(Classify classify, bool adaptive) {
  DirectVolume volume;
  volume.function = {{{0.2, {0.9, 0.3, 0.1}}, {0.5, {0.2, 0.7, 0.3}}, {0.8, {0.3, 0.4, 1.0}}},
                     {{0.15, 0.0}, {0.3, 0.25}, {0.42, 0.0}, {0.6, 0.0}, {0.75, 0.5}, {0.9, 0.1}},
                     2.0};
  volume.classify = classify;
  volume.adaptive = adaptive;
  volume.finest = 0.02;
  volume.entries = classify == Classify::post ? 4096 : 256;
  volume.step = classify == Classify::post ? 0.6 : 1.0;
  volume.termination = 1.0 / 4096;
  return volume;
}

struct VoidLook {
  std::string name;
  std::function<void(Scene&)> choose;
};

/// Every way to look: first roots, surfaces behind each other, marched ones, volumes by each classification, and together.
std::vector<VoidLook> void_looks() {
  const std::vector<Isosurface> clear{{0.45, {1.0, 1.0, 0.2}, 0.4}, {0.62, {0.2, 0.2, 0.9}, 0.3}};
  const auto volume = [](Classify classify, bool adaptive) {
    return [=](Scene& s) { s.isosurfaces.clear(), s.volume = look(classify, adaptive); };
  };
  return {{"first roots", [](Scene&) {}},
          {"clear surfaces", [=](Scene& s) { s.isosurfaces = clear; }},
          {"marched", [](Scene& s) { s.intersect = Intersect::march, s.step = 0.7; }},
          {"marched in long steps, clear", [=](Scene& s) { s.intersect = Intersect::march, s.step = 2.3, s.isosurfaces = clear; }},
          {"post", volume(Classify::post, false)},
          {"pre-integrated", volume(Classify::pre_integrated, false)},
          {"adaptive", volume(Classify::post, true)},
          {"pre-integrated among clear surfaces", [=](Scene& s) { s.isosurfaces = clear, s.volume = look(Classify::pre_integrated, false); }}};
}

/// A request for the n-th view; every third one from inside, where some volumes are void.
Renderer::Request view_of(const Volume& volume, int view, int size) {
  Renderer::Request request = request_for(volume, 0.55, size, 30.0 + 100.0 * view, 60.0 - 50.0 * (view % 3));
  if (view % 3 == 2) {
    request.scene.camera.eye = volume.world.to_world({11.4, 11.7, 10.2});
    request.scene.camera.fov = 80.0;
  }
  return request;
}

Renderer::Config config_of(std::string_view spline) {
  Renderer::Config config;
  config.spline = spline;
  config.nan = kEmpty;
  return config;
}

class EverySpline : public DeviceTest, public ::testing::WithParamInterface<const char*> {
 protected:
  const LatticeKind lattice = make_spline(GetParam())->lattice();
};

TEST_P(EverySpline, ShowsVoidCellsAsTheReferenceDoes) {
  // A place within rounding, 2e-5 cells, of a void cell's border is on either side of it: few rays have one; seen in a volume, a stretch
  // more or less is then opaque.
  std::size_t pixels = 0, differing = 0, seen = 0;
  int view = 0;
  for (const VoidVolume& v : void_volumes(lattice, kMirroredWorld)) {
    DeviceRenderer device(test_kernels(), v.volume, config_of(GetParam()));
    ReferenceRenderer reference(v.volume, config_of(GetParam()));
    for (const VoidLook& l : void_looks()) {
      Renderer::Request request = view_of(v.volume, view++, 32);
      l.choose(request.scene);
      request.skip = {.structure = "grid", .block = 4};
      RenderStats stats;
      const Frame frame = device.render(request, stats), truth = reference.render(request, stats);
      std::size_t off = 0, hits = 0;
      for (std::size_t p = 0; p < truth.depth.size(); ++p) {
        double most = 0.0;
        for (int c = 0; c < 4; ++c) most = std::max(most, std::abs(double(frame.color[4 * p + c]) - truth.color[4 * p + c]));
        off += most > 4e-3;
        hits += truth.color[4 * p + 3] > 0.01f;
      }
      EXPECT_LE(off, 12u) << v.name << ", " << l.name;
      EXPECT_TRUE(v.name != "all" || count_hits(frame) == 0) << l.name;
      pixels += truth.depth.size(), differing += off, seen += hits;
    }
  }
  std::printf("%s: %zu of %zu pixels differ, %zu show something\n", GetParam(), differing, pixels, seen);
  EXPECT_LT(double(differing), 2e-3 * double(pixels));
  EXPECT_GT(4 * seen, pixels);
}

TEST_P(EverySpline, ShowsOutsideVoidCellsWhatTheExtendedVolumeShows) {
  std::size_t same = 0, hidden = 0;
  int view = 0;
  for (const VoidVolume& v : void_volumes(lattice, kMirroredWorld)) {
    const Emptied e(v.volume, GetParam());
    DeviceRenderer emptied(test_kernels(), v.volume, config_of(GetParam())), extended(test_kernels(), e.volume, config_of(GetParam()));
    const Renderer::Request request = view_of(v.volume, view++, 64);
    RenderStats stats;
    const Frame a = emptied.render(request, stats);
    EXPECT_EQ(stats.void_cells, e.voids.count);
    const Frame b = extended.render(request, stats);
    EXPECT_EQ(stats.void_cells, 0u);
    const CameraFrame camera = camera_frame(request.scene.camera, 64, 64);
    const RaySpace space = ray_space(lattice, v.volume.extents, v.volume.world, request.scene.camera.eye);
    for (int p = 0; p < 64 * 64; ++p) {
      const auto ray = clip_ray(space, pixel_direction(camera, 64, 64, p % 64, p / 64));
      if (!ray) continue;
      VoidStretches stretches;
      stretches.find(*ray, glm::ivec3(e.voids.cells), &e.voids);
      const double s_a = (a.depth[p] - ray->entry) / ray->scale, s_b = (b.depth[p] - ray->entry) / ray->scale;
      if (!stretches.touch(-1e-3, std::min(s_b, ray->length) + 1e-3)) {
        ASSERT_EQ(std::memcmp(&a.depth[p], &b.depth[p], sizeof(float)), 0) << v.name;
        ASSERT_EQ(std::memcmp(&a.color[4 * p], &b.color[4 * p], 4 * sizeof(float)), 0) << v.name;
        ASSERT_EQ(std::memcmp(&a.normal[3 * p], &b.normal[3 * p], 3 * sizeof(float)), 0) << v.name;
        ++same;
      } else if (std::isfinite(s_a)) {
        EXPECT_FALSE(stretches.touch(s_a, s_a) && stretches.touch(s_a - 1e-3, s_a - 1e-3) && stretches.touch(s_a + 1e-3, s_a + 1e-3))
            << v.name << ": a hit inside a void cell";
      }
      hidden += a.depth[p] != b.depth[p];
    }
  }
  EXPECT_GT(same, 1000u);
  EXPECT_GT(hidden, 1000u);
}

TEST_P(EverySpline, ShowsTheSamePictureWithEveryStructureAsWithNone) {
  // Each look sees every other structure, in turns with and without the cell test, and the Cartesian splines share the looks: compiling kernels
  // is what takes time.
  std::vector<VoidVolume> volumes = void_volumes(lattice, kMirroredWorld);
  volumes.pop_back();  // the one without voids
  RenderStats stats;
  int view = 0, look_number = 0;
  for (const VoidLook& l : void_looks()) {
    ++look_number;
    if (lattice == LatticeKind::cartesian && look_number % 2 == (GetParam() == std::string_view("trilinear"))) continue;
    std::vector<std::unique_ptr<DeviceRenderer>> renderers;
    std::vector<Renderer::Request> requests;
    std::vector<Frame> truths;
    for (const VoidVolume& v : volumes) {
      renderers.push_back(std::make_unique<DeviceRenderer>(test_kernels(), v.volume, config_of(GetParam())));
      Renderer::Request request = view_of(v.volume, view++, 16);
      l.choose(request.scene);
      request.skip.structure = "none";
      truths.push_back(renderers.back()->render(request, stats));
      requests.push_back(request);
    }
    int blocks = look_number;
    for (std::size_t number = std::size_t(look_number / 2 % 2); number < skip_labels().size(); number += 2) {
      const std::string_view label = skip_labels()[number];
      const bool cell_test = (std::size_t(look_number) + number / 2) % 2 == 0;
      for (std::size_t n = 0; n < volumes.size() && label != "none"; ++n) {
        const int block = 1 << (blocks++ % 5);
        requests[n].skip = labelled_skip(label, {.block = block, .cell_test = cell_test});
        SCOPED_TRACE(volumes[n].name + ", " + l.name + ", " + std::string(label) + ", block " + std::to_string(block) + (cell_test ? ", cells tested" : ""));
        expect_same_picture(renderers[n]->render(requests[n], stats), truths[n]);
        EXPECT_TRUE(volumes[n].name != "all" || stats.active_blocks == 0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EverySpline, ::testing::Values("bcc7", "trilinear", "tricubic"));

std::vector<float> alphas(const Frame& frame) {
  std::vector<float> all;
  for (std::size_t p = 0; p < frame.depth.size(); ++p) all.push_back(frame.color[4 * p + 3]);
  return all;
}

TEST_F(DeviceTest, HasNoSurfaceFromOneSideOfAVoidToTheOther) {
  // 0 in front of a slab that is not finite, 1 behind it, with a sheet of the other value on either side: rays are looked at in front of
  // the slab and behind it, and cross four surfaces. One in the slab, which walks may pass over unseen, would be a fifth.
  for (const std::string_view spline : {"bcc7", "trilinear", "tricubic"}) {
    const Volume volume = field_volume(make_spline(spline)->lattice(), [](const glm::dvec3& u) {
      if (u.x == 9.0 || u.x == 10.0) return std::numeric_limits<double>::quiet_NaN();
      return u.x < 9.0 ? (u.x == 3.0 || u.x == 4.0 ? 1.0 : 0.0) : (u.x == 17.0 || u.x == 18.0 ? 0.0 : 1.0);
    });
    DeviceRenderer renderer(test_kernels(), volume, config_of(spline));
    for (const Intersect way : {Intersect::exact, Intersect::march})
      for (const std::string_view label : {"none", "grid", "octree", "distance"}) {
        Renderer::Request request = request_for(volume, 0.5, 8);
        request.scene.isosurfaces.front().opacity = 0.5;
        request.scene.camera = {{-60.0, 11.3, 11.2}, {0.0, 11.4, 11.3}, {0.0, 0.0, 1.0}, 8.0};
        request.scene.intersect = way;
        request.skip = labelled_skip(label, {.block = 4, .cell_test = label != "octree"});
        RenderStats stats;
        const Frame frame = renderer.render(request, stats);
        EXPECT_THAT(alphas(frame), ::testing::Each(1.0f - 1.0f / 16.0f)) << spline << ", " << label << (way == Intersect::exact ? ", exact" : ", marched");
      }
  }
}

bool has_voids(const std::vector<Feature>& features) {
  for (const Feature& f : features)
    if (f.name == "void cells") return f.compiled;
  ADD_FAILURE() << "no row of void cells";
  return false;
}

TEST_F(DeviceTest, HasVoidCellsInItsKernelsOnlyWhereThereAreSome) {
  const std::vector<VoidVolume> all = void_volumes(LatticeKind::bcc);
  const Volume &ball = all.front().volume, &none = all.back().volume;
  Volume integers = none;
  integers.samples = std::vector<std::uint8_t>(none.sample_count(), 3);
  DeviceRenderer with(test_kernels(), ball, config_of("bcc7")), without(test_kernels(), none, config_of("bcc7")), of_integers(test_kernels(), integers, config_of("bcc7"));
  for (const char* structure : {"none", "grid"}) {
    Renderer::Request request = request_for(ball, 0.5, 8);
    request.skip = {.structure = structure, .block = 4};
    EXPECT_TRUE(has_voids(with.explain(request)));
    EXPECT_FALSE(has_voids(without.explain(request)));
    EXPECT_FALSE(has_voids(of_integers.explain(request)));
  }
  RenderStats stats;
  with.render(request_for(ball, 0.5, 8), stats);
  EXPECT_GT(stats.void_cells, 0u);
  of_integers.render(request_for(ball, 0.5, 8), stats);
  EXPECT_EQ(stats.void_cells, 0u);
}

TEST_F(DeviceTest, ShowsAFilledVolumeWholeAndBrickByBrickAsOneOfTheseSamples) {
  for (const std::string_view spline : {"bcc7", "tricubic"}) {
    const VoidVolume v = void_volumes(make_spline(spline)->lattice()).front();
    Volume filled = v.volume;
    fill_not_finite(filled, 0.9);
    Renderer::Config config = config_of(spline);
    config.nan = {NanPolicy::Kind::fill, 0.9};
    Renderer::Request request = request_for(v.volume, 0.7, 32);
    request.skip = {.structure = "grid", .block = 8, .cell_test = false};
    RenderStats stats;
    const Frame truth = DeviceRenderer(test_kernels(), filled, config_of(spline)).render(request, stats);
    expect_same_picture(DeviceRenderer(test_kernels(), v.volume, config).render(request, stats), truth);
    EXPECT_EQ(stats.void_cells, 0u);
    config.pool_bytes = 1 << 20;
    config.brick = 8;
    expect_same_picture(DeviceRenderer(test_kernels(), std::make_shared<VolumeSource>(v.volume), "ball", config).render(request, stats), truth);
    EXPECT_GT(stats.bricks.loads, 0u);
  }
}

TEST_F(DeviceTest, RefusesVoidCellsBrickByBrickAndSamplesThatAreNotFiniteUnlessToldWhatToDo) {
  const VoidVolume v = void_volumes(LatticeKind::bcc).front();
  Renderer::Config config = config_of("bcc7");
  config.pool_bytes = 1 << 20;
  try {
    DeviceRenderer(test_kernels(), std::make_shared<VolumeSource>(v.volume), "ball", config);
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("--nan: found empty"));
  }
  RenderStats stats;
  EXPECT_THROW(DeviceRenderer(test_kernels(), v.volume, {}).render(request_for(v.volume, 0.5, 8), stats), InputError);
}

}  // namespace
}  // namespace quincunx

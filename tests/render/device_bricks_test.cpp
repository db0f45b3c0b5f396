// Pictures through a pool of bricks: bit for bit those with all coefficients on the device, however few bricks fit.
#include "render/device_bricks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "accel/structure.h"
#include "lattice/error.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();  // slots: one for each brick

/// Hills and hollows from -1.2 to 1.2 with a little noise.
Volume bumps(LatticeKind lattice, const Extents& n, const World& world = {}) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  const double step = lattice == LatticeKind::bcc ? 1.0 : 1.4;
  Volume volume = bcc_volume(n, [&](const glm::dvec3& u) {
    return std::sin(0.45 * step * u.x + 0.2) * std::cos(0.4 * step * u.y) + 0.3 * std::sin(0.3 * step * u.z) + noise(random);
  }, world);
  volume.lattice = lattice;
  if (lattice == LatticeKind::cartesian) std::get<std::vector<float>>(volume.samples).resize(std::size_t(n.x * n.y * n.z));
  return volume;
}

World skewed_world() { return {.origin = {3.0, -7.0, 11.0}, .axes = glm::dmat3(1.0, 0.2, 0.0, -0.3, 0.8, 0.1, 0.0, 0.4, -1.3)}; }

/// Opaque twice, with nothing in between and around.
DirectVolume glow() {
  DirectVolume volume;
  volume.function.colors = {{-0.5, {0.1, 0.3, 0.9}}, {0.6, {0.9, 0.5, 0.1}}};
  volume.function.opacities = {{-0.5, 0.0}, {-0.3, 0.25}, {-0.1, 0.0}, {0.3, 0.0}, {0.6, 0.5}, {0.9, 0.0}};
  return volume;
}

/// One way to look at `bumps`.
struct BrickLook {
  std::string name;
  std::vector<Isosurface> surfaces;
  std::optional<DirectVolume> volume;
};
std::vector<BrickLook> brick_looks() {
  const Isosurface opaque{0.4, {0.9, 0.8, 0.7}, 1.0}, clear{0.4, {0.9, 0.3, 0.1}, 0.4}, blue{-0.2, {0.2, 0.3, 0.9}, 0.5}, core{0.8, {0.9, 0.9, 0.2}, 1.0};
  DirectVolume pre_integrated = glow(), adaptive = glow(), jittered = glow(), quick = glow();
  pre_integrated.classify = Classify::pre_integrated, pre_integrated.entries = 64;
  adaptive.adaptive = true, adaptive.modulate_from = 0.05, adaptive.modulate_to = 0.4, adaptive.step = 1.7;
  jittered.jitter = 7, jittered.shade = false, jittered.step = 0.6;
  quick.termination = 0.3;
  return {{"opaque", {opaque}, {}}, {"clear", {clear}, {}}, {"several", {core, clear, blue}, {}}, {"volume", {}, quick},
          {"pre-integrated", {}, pre_integrated}, {"adaptive, modulated", {}, adaptive}, {"jittered", {}, jittered},
          {"volume and surfaces", {core, blue}, glow()}, {"pre-integrated volume and a surface", {opaque}, pre_integrated},
          {"adaptive volume and a surface", {clear}, adaptive}};
}

Renderer::Request request_for(const Volume& volume, const BrickLook& look, int size, double azimuth = 30.0) {
  Renderer::Request request = request_for(volume, 0.0, size, azimuth);
  request.scene.isosurfaces = look.surfaces;
  request.scene.volume = look.volume;
  request.scene.background = {0.1, 0.2, 0.3};
  request.skip = {.structure = "grid", .block = 8, .cell_test = false};
  return request;
}

class DeviceBricksTest : public DeviceTest {
 protected:
  static Renderer::Config config_of(const Volume& volume, std::string_view spline, int edge, std::uint64_t slots) {
    Renderer::Config config;
    config.spline = spline.empty() ? default_spline(volume.lattice) : spline;
    config.brick = edge;
    const BrickLayout layout(volume.lattice, volume.extents, make_spline(config.spline)->apron(), edge);
    config.pool_bytes = std::min(slots, std::uint64_t(layout.count())) * layout.slot_bytes();
    return config;
  }

  /// A renderer whose pool has so many slots. Keeps a reference to `volume`.
  static DeviceRenderer pooled(const Volume& volume, std::string_view spline, int edge, std::uint64_t slots, const DeviceLimits& limits = {}) {
    return {test_kernels(), std::make_shared<VolumeSource>(volume), "bumps.nrrd", config_of(volume, spline, edge, slots), limits};
  }

  static Frame whole(const Volume& volume, std::string_view spline, const Renderer::Request& request) {
    Renderer::Config config;
    config.spline = spline.empty() ? default_spline(volume.lattice) : spline;
    DeviceRenderer renderer(test_kernels(), volume, config);
    RenderStats stats;
    return renderer.render(request, stats);
  }

  /// What holds of every pool.
  static void expect_counters(const BrickStats& bricks, const Volume& volume, const Renderer::Config& config) {
    const BrickLayout layout(volume.lattice, volume.extents, make_spline(config.spline)->apron(), config.brick);
    EXPECT_EQ(bricks.edge, config.brick);
    EXPECT_EQ(bricks.count, std::uint64_t(layout.count()));
    EXPECT_EQ(bricks.slots, *config.pool_bytes / layout.slot_bytes());
    EXPECT_EQ(bricks.loads, bricks.resident + bricks.evictions);
    EXPECT_EQ(bricks.loaded_bytes, bricks.loads * layout.slot_bytes());
    EXPECT_LE(bricks.resident, bricks.slots);
    EXPECT_LE(bricks.rounds, bricks.loads) << "every round loads a brick";
    EXPECT_TRUE(bricks.slots < bricks.count || bricks.evictions == 0);
  }

  /// What an InputError says.
  static std::string refusal(const std::function<void()>& act) {
    try {
      act();
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

/// Every look through pools of one slot, a few and all, with bricks of every size.
class EveryLook : public DeviceBricksTest, public ::testing::WithParamInterface<std::string_view> {};

TEST_P(EveryLook, IsTheSameThroughAPool) {
  const LatticeKind lattice = make_spline(GetParam())->lattice();
  // 21 x 17 x 25 cells of either lattice, or one more or less: no multiples of bricks.
  const Volume volume = bumps(lattice, lattice == LatticeKind::bcc ? Extents(11, 9, 13) : Extents(22, 18, 25), skewed_world());
  const std::vector<std::pair<int, std::uint64_t>> pools{{4, 40}, {8, 1}, {8, 5}, {16, 1}, {16, kAll}, {64, 1}};
  std::vector<DeviceRenderer> renderers;
  for (const auto& [edge, slots] : pools) renderers.push_back(pooled(volume, GetParam(), edge, slots));
  std::uint64_t evictions = 0;
  const bool polynomial = make_spline(GetParam())->polynomial();
  for (const BrickLook& look : brick_looks()) {
    if (!polynomial && !look.surfaces.empty()) continue;
    const Renderer::Request request = request_for(volume, look, 24);
    const Frame truth = whole(volume, GetParam(), request);
    EXPECT_GT(std::count_if(truth.depth.begin(), truth.depth.end(), [](float z) { return std::isfinite(z); }), 100) << look.name;
    for (std::size_t n = 0; n < pools.size(); ++n) {
      SCOPED_TRACE(look.name + ", bricks of " + std::to_string(pools[n].first) + ", slots " + std::to_string(pools[n].second));
      RenderStats stats;
      expect_same_picture(renderers[n].render(request, stats), truth);
      expect_counters(stats.bricks, volume, config_of(volume, GetParam(), pools[n].first, pools[n].second));
      if (look.name == (polynomial ? "clear" : "volume")) evictions += stats.bricks.evictions;
    }
  }
  EXPECT_GT(evictions, 30u) << "pools were too small";
}

// Small volumes (below) are seen with every spline; all looks with three, as compiling so many kernels takes long.
INSTANTIATE_TEST_SUITE_P(Splines, EveryLook, ::testing::Values("bcc7", "trilinear", "tricubic"), [](const auto& spline) { return std::string(spline.param); });

TEST_F(DeviceBricksTest, EveryStructureWithBlocksOfEverySizeShowsTheSame) {
  const Volume volume = bumps(LatticeKind::cartesian, {19, 22, 17});
  for (const BrickLook& look : {brick_looks()[2], brick_looks()[3]}) {
    const Frame truth = whole(volume, "trilinear", request_for(volume, look, 20));
    DeviceRenderer renderer = pooled(volume, "trilinear", 8, 4);
    std::size_t n = 0;
    for (const std::string_view label : skip_labels())
      for (const int block : {8, 32, 1, 4, 0}) {
        if (++n % 2 == 0 && block != 0) continue;  // each block with every other structure
        Renderer::Request request = request_for(volume, look, 20);
        request.skip = labelled_skip(label, {.block = block, .cell_test = n % 3 == 0});
        SCOPED_TRACE(look.name + ", " + std::string(label) + ", block " + std::to_string(block));
        RenderStats stats;
        expect_same_picture(renderer.render(request, stats), truth);
        EXPECT_FALSE(stats.skip.cell_test) << "there are no bounds of cells";
      }
  }
}

TEST_F(DeviceBricksTest, SmallVolumesAreSeenThroughOneSlotOfTheLeastBricks) {
  for (const Extents& n : {Extents(1, 1, 40), Extents(37, 1, 2), Extents(2, 3, 5), Extents(6, 7, 6), Extents(1, 1, 1)})
    for (const std::string_view spline : spline_names()) {
      const Volume volume = bumps(make_spline(spline)->lattice(), n);
      for (const BrickLook& look : {brick_looks()[1], brick_looks()[4]}) {
        if (!make_spline(spline)->polynomial() && !look.surfaces.empty()) continue;
        SCOPED_TRACE(std::string(spline) + ", " + look.name + ", " + std::to_string(n.x) + " x " + std::to_string(n.y) + " x " + std::to_string(n.z));
        const Renderer::Request request = request_for(volume, look, 10, 60.0);
        DeviceRenderer renderer = pooled(volume, spline, 4, 1);
        RenderStats stats;
        expect_same_picture(renderer.render(request, stats), whole(volume, spline, request));
      }
    }
}

TEST_F(DeviceBricksTest, TheEyeMayBeInsideTheVolume) {
  const Volume volume = bumps(LatticeKind::bcc, {12, 12, 12});
  for (const BrickLook& look : {brick_looks()[2], brick_looks()[7]}) {
    Renderer::Request request = request_for(volume, look, 24);
    request.scene.camera.eye = 0.97 * request.scene.camera.target + 0.03 * request.scene.camera.eye;
    request.scene.camera.fov = 80.0;
    DeviceRenderer renderer = pooled(volume, "", 8, 2);
    RenderStats stats;
    expect_same_picture(renderer.render(request, stats), whole(volume, "", request));
  }
}

TEST_F(DeviceBricksTest, PicturesInBandsAreThoseInOne) {
  const Volume volume = bumps(LatticeKind::bcc, {10, 10, 10});
  for (const BrickLook& look : {brick_looks()[2], brick_looks()[3]}) {
    Renderer::Request request = request_for(volume, look, 40);
    request.scene.cost = true;
    DeviceRenderer banded = pooled(volume, "", 8, 3, {.texel_elements = 0, .frame_bytes = 40 * 96 * 17});  // 16 rows
    RenderStats stats;
    const Frame found = banded.render(request, stats), truth = whole(volume, "", request);
    expect_same_picture(found, truth);
    // A ray goes on where it waited: nothing is evaluated twice.
    EXPECT_EQ(cost_sums(found).evaluations, cost_sums(truth).evaluations);
  }
}

TEST_F(DeviceBricksTest, SlotsMayLieAcrossTexelBuffers) {
  const Volume volume = bumps(LatticeKind::cartesian, {22, 20, 18});
  for (const BrickLook& look : {brick_looks()[1], brick_looks()[3]}) {
    const Renderer::Request request = request_for(volume, look, 24);
    // 12^3 floats a slot, seven of them in six buffers of 2^11.
    DeviceRenderer renderer = pooled(volume, "tricubic", 8, 7, {.texel_elements = 2100, .frame_bytes = 0});
    RenderStats stats;
    expect_same_picture(renderer.render(request, stats), whole(volume, "tricubic", request));
    EXPECT_GT(renderer.variant(request).coefficient_buffers, 4);
  }
}

TEST_F(DeviceBricksTest, AKeptPoolShowsWhateverIsAskedForNext) {
  const Volume volume = bumps(LatticeKind::bcc, {10, 11, 12});
  DeviceRenderer renderer = pooled(volume, "", 8, 6);
  RenderStats stats;
  std::uint64_t loads = 0;
  for (const auto& [number, azimuth, block] : {std::tuple{1, 30.0, 8}, {3, 100.0, 2}, {2, 200.0, 4}, {1, 30.0, 32}, {0, 300.0, 0}}) {
    Renderer::Request request = request_for(volume, brick_looks()[std::size_t(number)], 20, azimuth);
    request.skip.block = block;
    const Frame found = renderer.render(request, stats);
    request.skip.block = 8;
    expect_same_picture(found, whole(volume, "", request));
    EXPECT_GE(stats.bricks.loads, loads);
    loads = stats.bricks.loads;
  }
}

TEST_F(DeviceBricksTest, ARendererThatWasInterruptedShowsTheTruthAfterwards) {
  const Volume volume = bumps(LatticeKind::bcc, {10, 11, 12});
  const Renderer::Request request = request_for(volume, brick_looks()[1], 20);
  const Frame truth = whole(volume, "", request);
  DeviceRenderer renderer = pooled(volume, "", 8, 3);
  RenderStats stats;
  int interrupted = 0;
  for (int calls = 1; calls < 60; calls += 7) {
    int left = calls;
    const auto interrupt = [&](double) {
      if (--left == 0) throw std::runtime_error("interrupted");
    };
    try {
      renderer.render(request, stats, interrupt);
    } catch (const std::runtime_error&) {
      ++interrupted;
    }
    expect_same_picture(renderer.render(request, stats), truth);
  }
  EXPECT_GE(interrupted, 1);
}

TEST_F(DeviceBricksTest, OnlyBricksAboutWhatIsSeenAreLoaded) {
  // A small ball in a corner of 64^3 cells.
  const glm::dvec3 centre(12.0, 50.0, 14.0);
  Volume volume = bcc_volume({65, 65, 65}, [&](const glm::dvec3& u) { return std::max(0.0, 1.0 - glm::distance(0.5 * u, centre) / 10.0); });
  volume.lattice = LatticeKind::cartesian;
  auto& samples = std::get<std::vector<float>>(volume.samples);
  samples.resize(samples.size() / 2);
  const BrickLayout layout(volume.lattice, volume.extents, make_spline("trilinear")->apron(), 8);
  std::uint64_t near = 0;
  for (std::int32_t n = 0; n < layout.count(); ++n) {
    const glm::dvec3 corner(layout.brick(n) * 8);
    near += glm::distance(glm::clamp(centre, corner, corner + 8.0), centre) < 6.0;  // the surface is at 5
  }
  for (const bool seen_as_volume : {false, true}) {
    Renderer::Request request = request_for(volume, {"", {{0.5, {1, 1, 1}, 1.0}}, {}}, 48);
    if (seen_as_volume) {
      request.scene.isosurfaces.clear();
      request.scene.volume = DirectVolume{};
      request.scene.volume->function = {.colors = {{0.0, {1, 1, 1}}}, .opacities = {{0.5, 0.0}, {0.8, 0.2}}};
    }
    request.skip.block = 4;
    DeviceRenderer renderer = pooled(volume, "trilinear", 8, kAll);
    RenderStats stats;
    expect_same_picture(renderer.render(request, stats), whole(volume, "trilinear", request));
    EXPECT_GT(stats.hits, 10u);
    EXPECT_GT(stats.bricks.loads, 2u);
    EXPECT_LE(stats.bricks.loads, near);
    EXPECT_LT(near, stats.bricks.count / 20);
    renderer.render(request, stats);
    EXPECT_LE(stats.bricks.loads, near) << "loaded again";
  }
}

TEST_F(DeviceBricksTest, WhatIsHiddenIsNotLoaded) {
  // Sheets behind each other, each in the way of all rays.
  const Volume volume = bcc_volume({20, 10, 10}, [](const glm::dvec3& u) { return std::sin(0.8 * u.x); });
  Renderer::Request request = request_for(volume, {"", {{0.5, {1, 1, 1}, 1.0}}, {}}, 24);
  request.scene.camera.eye = {-200.0, 9.5, 9.5};
  request.scene.camera.target = {20.0, 9.5, 9.5};
  request.scene.camera.fov = 4.0;
  DeviceRenderer renderer = pooled(volume, "", 4, kAll);
  RenderStats stats;
  expect_same_picture(renderer.render(request, stats), whole(volume, "", request));
  EXPECT_GT(stats.hits, 300u);
  EXPECT_EQ(stats.bricks.count, 10u * 5u * 5u);
  EXPECT_LE(stats.bricks.loads, 5u * 5u) << "more than the first layer of bricks";
}

TEST_F(DeviceBricksTest, SamplesThatAreNotFiniteAreRefusedHoweverEmptySpaceIsSkipped) {
  Volume volume = bumps(LatticeKind::cartesian, {9, 8, 7});
  auto& samples = std::get<std::vector<float>>(volume.samples);
  samples[(3 * 8 + 2) * 9 + 1] = std::numeric_limits<float>::quiet_NaN();
  samples[(6 * 8 + 7) * 9 + 8] = std::numeric_limits<float>::infinity();
  for (const std::string structure : {"none", "grid", "auto"}) {
    DeviceRenderer renderer = pooled(volume, "trilinear", 4, 8);
    Renderer::Request request = request_for(volume, brick_looks()[0], 8);
    request.skip = {.structure = structure};
    RenderStats stats;
    EXPECT_THAT(refusal([&] { renderer.render(request, stats); }), AllOf(HasSubstr("bumps.nrrd"), HasSubstr("2 NaN or infinite of 504"), HasSubstr("index (1, 2, 3)"))) << structure;
  }
}

TEST_F(DeviceBricksTest, WhatAPoolCannotShowIsRefused) {
  const Volume volume = bumps(LatticeKind::bcc, {6, 6, 6});
  DeviceRenderer renderer = pooled(volume, "", 4, 8);
  RenderStats stats;
  Renderer::Request request = request_for(volume, brick_looks()[0], 8);
  request.scene.intersect = Intersect::march;
  EXPECT_THAT(refusal([&] { renderer.render(request, stats); }), AllOf(HasSubstr("--pool"), HasSubstr("march"), HasSubstr("exact")));
  request = request_for(volume, brick_looks()[0], 8);
  request.scene.normal = Normal::central;
  EXPECT_THAT(refusal([&] { renderer.render(request, stats); }), AllOf(HasSubstr("--pool"), HasSubstr("central"), HasSubstr("analytic")));
  const auto source = std::make_shared<VolumeSource>(volume);
  EXPECT_THAT(refusal([&] { make_renderer("cpu", source, "bumps.nrrd", config_of(volume, "", 4, 8)); }), AllOf(HasSubstr("--pool"), HasSubstr("cpu")));
  Renderer::Config small = config_of(volume, "", 4, 1);
  --*small.pool_bytes;
  DeviceRenderer cramped(test_kernels(), source, "bumps.nrrd", small);
  EXPECT_THAT(refusal([&] { cramped.render(request_for(volume, brick_looks()[0], 8), stats); }),
              AllOf(HasSubstr("--pool"), HasSubstr(std::to_string(*small.pool_bytes + 1) + " bytes")));
}

}  // namespace
}  // namespace quincunx

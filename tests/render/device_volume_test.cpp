// Volumes as the device shows them against the reference in double precision.
#include <gtest/gtest.h>

#include "lattice/error.h"
#include "render/reference_renderer.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {


/// Waves between 0 and 1, curved everywhere, 23 cells along each axis.
Volume waves(LatticeKind lattice) {
  const auto f = [](const glm::dvec3& u) { return 0.5 + 0.25 * std::sin(0.5 * u.x + 0.1 * u.z) + 0.25 * std::cos(0.4 * u.y - 0.35 * u.z); };
  if (lattice == LatticeKind::bcc) return bcc_volume({12, 12, 12}, f, kMirroredWorld);
  Volume volume;
  volume.extents = {24, 24, 24};
  volume.world = kMirroredWorld;
  std::vector<float> samples;
  for (int n = 0; n < 24 * 24 * 24; ++n) samples.push_back(float(f({n % 24, n / 24 % 24, n / 576})));
  volume.samples = std::move(samples);
  return volume;
}

/// Two stretches of values with opacity, of changing colour.
DirectVolume look() {
  DirectVolume volume;
  volume.function = {{{0.2, {0.9, 0.3, 0.1}}, {0.5, {0.2, 0.7, 0.3}}, {0.8, {0.3, 0.4, 1.0}}},
                     {{0.15, 0.0}, {0.3, 0.25}, {0.42, 0.0}, {0.6, 0.0}, {0.75, 0.5}, {0.9, 0.1}},
                     2.0};
  volume.step = 0.4;
  volume.termination = 0.0;
  return volume;
}

struct VolumeLook {
  std::string name;
  DirectVolume volume;
  std::vector<Isosurface> surfaces;
};

/// Every way to classify, with and without what else there is.
std::vector<VolumeLook> volume_looks() {
  const std::vector<Isosurface> clear{{0.5, {1.0, 1.0, 0.2}, 0.4}, {0.72, {0.2, 0.2, 0.9}, 0.3}}, opaque{{0.66, {0.7, 0.7, 0.7}, 1.0}};
  std::vector<VolumeLook> all(6, {"", look(), {}});
  all[0].name = "post";
  all[1].name = "pre-integrated";
  all[1].volume.classify = Classify::pre_integrated;
  all[1].volume.step = 1.0;
  all[2].name = "adaptive, modulated, jittered";
  all[2].volume.adaptive = true;
  all[2].volume.modulate_from = 0.02, all[2].volume.modulate_to = 0.2;
  all[2].volume.jitter = 7;
  all[3].name = "post without light, behind an opaque surface";
  all[3].volume.shade = false;
  all[3].surfaces = opaque;
  all[4].name = "pre-integrated, modulated, without light, among clear surfaces";
  all[4].volume.classify = Classify::pre_integrated;
  all[4].volume.shade = false;
  all[4].volume.modulate_to = 0.15;
  all[4].surfaces = clear;
  all[5].name = "adaptive, jittered, among clear surfaces";
  all[5].volume.adaptive = true;
  all[5].volume.jitter = 0x7fa00001u;  // not a number as a float
  all[5].surfaces = clear;
  return all;
}

struct VolumeOff {
  double largest = 0.0, rms = 0.0;
  std::size_t seen = 0, depth = 0;  ///< pixels with opacity; whose depth is more than a stretch off
};

VolumeOff difference(const Frame& frame, const Frame& truth, double stretch) {
  VolumeOff off;
  for (std::size_t n = 0; n < truth.color.size(); ++n) {
    const double d = std::abs(double(frame.color[n]) - truth.color[n]);
    off.largest = std::max(off.largest, d);
    off.rms += d * d / double(truth.color.size());
  }
  off.rms = std::sqrt(off.rms);
  for (std::size_t p = 0; p < truth.depth.size(); ++p) {
    off.seen += truth.color[4 * p + 3] > 0.01f;
    const bool both = std::isfinite(frame.depth[p]) && std::isfinite(truth.depth[p]);
    off.depth += both ? std::abs(double(frame.depth[p]) - truth.depth[p]) > 1.01 * stretch : std::isfinite(frame.depth[p]) != std::isfinite(truth.depth[p]);
  }
  return off;
}

class DeviceVolume : public DeviceTest, public ::testing::WithParamInterface<const char*> {};

// What a picture may be off: places along the ray are off by 1e-6 of the domain or so, 2e-5 cells, values by that times the slope, 0.3 a
// cell, and by their own rounding, 2e-6: 1e-5 in all. Optical depth has at most 4.6 / 2 per unit length and value here, over 30 units:
// 7e-4 at the very most, where all errors have one sign; they do not, and the mean is a hundredth of that. The table's entries, 4096
// over a range of 0.75 (512 pre-integrated), add (h^2 / 8) of the second derivative of what they hold: 1e-6 (1e-4 where it is bent).
TEST_P(DeviceVolume, ShowsWhatTheReferenceShows) {
  const std::unique_ptr<Spline> spline = make_spline(GetParam());
  const Volume volume = waves(spline->lattice());
  Renderer::Config config;
  config.spline = GetParam();
  DeviceRenderer device(test_kernels(), volume, config);
  config.precision = Precision::float64;
  DeviceRenderer in_doubles(test_kernels(), volume, config);
  ReferenceRenderer reference(volume, config);
  int view = 0;
  for (const VolumeLook& look : volume_looks()) {
    if (!spline->polynomial() && !look.surfaces.empty()) continue;
    Renderer::Request request = request_for(volume, 0.0, 40, 30.0 + 50.0 * view, 50.0 - 20.0 * view);
    ++view;
    request.scene.isosurfaces = look.surfaces;
    request.scene.volume = look.volume;
    request.scene.background = {0.1, 0.2, 0.3};
    request.skip = {.structure = "grid", .block = 4};
    RenderStats stats;
    const Frame frame = device.render(request, stats), truth = reference.render(request, stats);
    const VolumeOff off = difference(frame, truth, look.volume.step * cell_length(kMirroredWorld));
    std::printf("%-10s %-62s largest %.1e  rms %.1e  of %zu pixels, %zu depths off\n", GetParam(), look.name.c_str(), off.largest, off.rms, off.seen, off.depth);
    EXPECT_GT(off.seen, 500u) << look.name;
    EXPECT_LT(off.largest, 7e-4) << look.name;
    EXPECT_LT(off.rms, 2e-5) << look.name;
    EXPECT_LE(off.depth, 1u) << look.name;
    // Doubles leave what the table's entries are off.
    const VolumeOff less = difference(in_doubles.render(request, stats), truth, look.volume.step * cell_length(kMirroredWorld));
    std::printf("%-10s %-62s largest %.1e  rms %.1e\n", "in doubles", "", less.largest, less.rms);
    EXPECT_LT(less.largest, 7e-4) << look.name;
    EXPECT_LT(less.rms, 2e-5) << look.name;
    EXPECT_EQ(less.depth, 0u) << look.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DeviceVolume, ::testing::Values("bcc7", "cwlb", "trilinear", "tricubic"));

TEST_F(DeviceTest, EndsAVolumesRaysWhereLittleIsLetThrough) {
  const Volume volume = waves(LatticeKind::bcc);
  DeviceRenderer device(test_kernels(), volume, {});
  RenderStats stats;
  Renderer::Request request = request_for(volume, 0.0, 40);
  request.scene.isosurfaces.clear();
  request.scene.volume = look();
  request.scene.volume->function.unit = 0.3;
  request.scene.cost = true;
  request.skip.structure = "none";
  const Frame whole = device.render(request, stats);
  request.scene.volume->termination = 0.25;
  const Frame ended = device.render(request, stats);
  EXPECT_LT(cost_sums(ended).evaluations, 0.9 * cost_sums(whole).evaluations);
  for (std::size_t n = 0; n < whole.color.size(); ++n) EXPECT_NEAR(ended.color[n], whole.color[n], 0.2501);
}

TEST_F(DeviceTest, RefusesStretchesTooManyToCount) {
  const Volume volume = bcc_volume({1, 1, 9000}, [](const glm::dvec3& u) { return 0.001 * u.z; });
  DeviceRenderer device(test_kernels(), volume, {});
  RenderStats stats;
  Renderer::Request request = request_for(volume, 0.0, 4);
  request.scene.isosurfaces.clear();
  request.scene.volume = look();
  request.skip.structure = "none";
  request.scene.volume->step = 0.001;
  try {
    device.render(request, stats);
    FAIL() << "rendered";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("--step: ")) << error.what();
  }
}

}  // namespace
}  // namespace quincunx

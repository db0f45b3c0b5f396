// Kernels that compute in 64-bit floats: against the reference, among each other, and where 32-bit floats do not do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "accel/structure.h"
#include "lattice/error.h"
#include "render/reference.h"
#include "tests/render/adversarial_volumes.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using DevicePrecisionTest = DeviceTest;

constexpr Precision kBoth[] = {Precision::float32, Precision::float64};

Frame picture_of(const Volume& volume, const Renderer::Request& request, Precision precision, const std::string& spline = {}) {
  Renderer::Config config;
  config.spline = spline;
  config.precision = precision;
  RenderStats stats;
  return DeviceRenderer(test_kernels(), volume, config).render(request, stats);
}

Frame truth_by(const Volume& volume, const Scene& scene, const std::string& spline_name = "bcc7") {
  const std::unique_ptr<Spline> spline = make_spline(spline_name);
  return render_reference(*spline, spline->coefficients(volume, Spline::Prefilter::automatic), scene, nullptr);
}

/// How far a picture is from the reference.
struct Agreement {
  std::size_t hits = 0;     ///< of the reference
  std::size_t strayed = 0;  ///< missed, false, or more than half a cell away
  std::int64_t ulps = 0;    ///< of the depths, the most
  double normal = 0.0;      ///< largest difference of a component
  double color = 0.0;       ///< likewise, of all pixels

  void operator+=(const Agreement& a) {
    hits += a.hits, strayed += a.strayed;
    ulps = std::max(ulps, a.ulps), normal = std::max(normal, a.normal), color = std::max(color, a.color);
  }
};

Agreement agreement(const Frame& frame, const Frame& truth, double cell = 1.0) {
  Agreement a;
  for (std::size_t p = 0; p < truth.depth.size(); ++p) {
    for (int c = 0; c < 4; ++c) a.color = std::max(a.color, std::abs(double(frame.color[4 * p + c]) - truth.color[4 * p + c]));
    const float found = frame.depth[p], expected = truth.depth[p];
    a.hits += std::isfinite(expected);
    const bool strayed = std::isfinite(found) != std::isfinite(expected) || std::abs(double(found) - expected) > 0.5 * cell;
    a.strayed += strayed;
    if (strayed || !std::isfinite(found)) continue;
    a.ulps = std::max(a.ulps, std::abs(std::int64_t(std::bit_cast<std::int32_t>(found)) - std::bit_cast<std::int32_t>(expected)));
    for (int c = 0; c < 3; ++c) a.normal = std::max(a.normal, std::abs(double(frame.normal[3 * p + c]) - truth.normal[3 * p + c]));
  }
  return a;
}

void print(const std::string& what, const Agreement& a) {
  std::printf("%-60s %6zu hits, %4zu strayed, %8lld ulps, normal %.1e, color %.1e\n", what.c_str(), a.hits, a.strayed, static_cast<long long>(a.ulps), a.normal, a.color);
}

/// The first coset of a BCC volume as a Cartesian one.
Volume cartesian_twin(Volume volume) {
  volume.lattice = LatticeKind::cartesian;
  auto& samples = std::get<std::vector<float>>(volume.samples);
  samples.resize(samples.size() / 2);
  return volume;
}

/// The n-th view of `c`, a volume of the same or its twin; every third is from inside, its eye on no surface.
Renderer::Request view_of(const AdversarialVolume& c, const Volume& volume, int view, int size) {
  Renderer::Request request = request_for(volume, c.isovalue, size, 31.0 + 120.0 * view, 75.0 - 60.0 * view);
  if (view == 2) {
    request.scene.camera.eye = 0.97 * request.scene.camera.target + 0.03 * request.scene.camera.eye;
    request.scene.camera.fov = 80.0;
  }
  return request;
}

TEST_F(DevicePrecisionTest, DoublesHitWhereTheReferenceHitsToTheLastBitOfADepth) {
  for (const std::string spline : {"bcc4", "bcc7", "bcc8", "trilinear", "tricubic"}) {
    Agreement all;
    int view = 0;
    for (const AdversarialVolume& c : adversarial_volumes()) {
      const Volume volume = make_spline(spline)->lattice() == LatticeKind::bcc ? c.volume : cartesian_twin(c.volume);
      const Renderer::Request request = view_of(c, volume, view++ % 3, 64);
      const Agreement a = agreement(picture_of(volume, request, Precision::float64, spline), truth_by(volume, request.scene, spline), cell_size(volume.world));
      print(spline + ", " + c.name, a);
      all += a;
    }
    print(spline, all);
    EXPECT_GT(all.hits, 5000u);
    EXPECT_EQ(all.strayed, 0u);
    EXPECT_LE(all.ulps, 1);
    EXPECT_LE(all.normal, 1e-6);
  }
}

TEST_F(DevicePrecisionTest, DoublesShowTheSurfacesBehindEachOtherThatTheReferenceShows) {
  Agreement all;
  int view = 1;
  for (const AdversarialVolume& c : adversarial_volumes()) {
    Renderer::Request request = view_of(c, c.volume, view++ % 3, 48);
    request.scene.isosurfaces = {{c.isovalue, {1, 0, 0}, 0.5}, {0.8 * c.isovalue + 0.05, {0, 1, 0}, 0.5}, {1.1 * c.isovalue + 0.02, {0, 0, 1}, 0.3}};
    const Agreement a = agreement(picture_of(c.volume, request, Precision::float64), truth_by(c.volume, request.scene), cell_size(c.volume.world));
    print(c.name, a);
    all += a;
  }
  EXPECT_GT(all.hits, 5000u);
  EXPECT_EQ(all.strayed, 0u);
  EXPECT_LE(all.ulps, 1);
  EXPECT_LE(all.color, 1e-6);
}

TEST_F(DevicePrecisionTest, DoublesMarchAsTheReferenceDoes) {
  Agreement all;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Volume volume = random_volume({10, 11, 9}, seed);
    Renderer::Request request = request_for(volume, 0.6, 64, 100.0 * seed);
    request.scene.intersect = Intersect::march;
    request.scene.step = 0.3;
    request.scene.normal = Normal::central;
    request.scene.delta = 0.4;
    all += agreement(picture_of(volume, request, Precision::float64), truth_by(volume, request.scene));
  }
  print("march", all);
  EXPECT_GT(all.hits, 3000u);
  EXPECT_EQ(all.strayed, 0u);
  EXPECT_LE(all.ulps, 1);
  EXPECT_LE(all.normal, 1e-6);
}

TEST_F(DevicePrecisionTest, DoublesSeeFromAHundredThousandVolumesAwayWhatTheReferenceSees) {
  const Volume volume = bcc_volume({16, 16, 16}, [](const glm::dvec3& u) { return std::sin(0.31 * u.x + 0.2 * u.y) + std::sin(0.4 * u.y - 0.13 * u.z); });
  Renderer::Request request = request_for(volume, 0.2, 96);
  Camera& camera = request.scene.camera;
  camera.eye = camera.target + 3.1e6 * glm::normalize(camera.eye - camera.target);
  camera.fov = 8e-4;
  const Frame truth = truth_by(volume, request.scene);
  const Agreement d = agreement(picture_of(volume, request, Precision::float64), truth), f = agreement(picture_of(volume, request, Precision::float32), truth);
  print("far, double", d), print("far, float", f);
  EXPECT_GT(d.hits, 3000u);
  EXPECT_EQ(d.strayed, 0u);
  EXPECT_LE(d.ulps, 1);
  EXPECT_LE(d.normal, 1e-6);
}

TEST_F(DevicePrecisionTest, DoublesTellASignalOfOneOnAnOffsetOfAMillion) {
  const Volume volume = bcc_volume({14, 14, 14}, [](const glm::dvec3& u) { return 1e6 + 0.5 + 0.25 * std::sin(0.31 * u.x + 0.2 * u.y) + 0.25 * std::sin(0.4 * u.y - 0.13 * u.z); });
  const Renderer::Request request = request_for(volume, 1e6 + 0.53, 96);
  const Frame truth = truth_by(volume, request.scene);
  const Agreement d = agreement(picture_of(volume, request, Precision::float64), truth), f = agreement(picture_of(volume, request, Precision::float32), truth);
  print("offset, double", d), print("offset, float", f);
  EXPECT_GT(d.hits, 3000u);
  EXPECT_EQ(d.strayed, 0u);
  EXPECT_LE(d.ulps, 1);
  EXPECT_LE(d.normal, 1e-5);
}

/// A ball, which the spline reproduces, looked at where rays touch it: pixels are 1e-10 cells apart.
TEST_F(DevicePrecisionTest, DoublesDecideRaysThatAlmostTouchAsTheReferenceDoes) {
  const glm::dvec3 centre(12.5);
  const Volume volume = bcc_volume({13, 13, 13}, [&](const glm::dvec3& u) { return 100.0 - glm::dot(u - centre, u - centre); });
  Renderer::Request request = request_for(volume, 100.0 - 64.0, 64);
  Camera& camera = request.scene.camera;
  camera.eye = centre + glm::dvec3(40.0, 3.0, 5.0);
  const glm::dvec3 away = camera.eye - centre;
  // A point where a ray from the eye touches the ball.
  const double along = 64.0 / glm::dot(away, away);
  const glm::dvec3 side = glm::normalize(glm::cross(away, glm::dvec3(0.3, 1.0, 0.2)));
  camera.target = centre + along * away + std::sqrt(64.0 * (1.0 - along)) * side;
  camera.up = side;
  camera.fov = 64.0 * 1e-10 / 40.0 * 180.0 / M_PI;
  const Frame truth = truth_by(volume, request.scene);
  const Agreement d = agreement(picture_of(volume, request, Precision::float64), truth), f = agreement(picture_of(volume, request, Precision::float32), truth);
  print("tangent, double", d), print("tangent, float", f);
  EXPECT_GT(d.hits, 64u * 20);
  EXPECT_LT(d.hits, 64u * 44);
  EXPECT_LE(d.strayed, 64u);
  EXPECT_GT(f.strayed, 64u * 10);
}

/// A valley whose two sides are a thousandth of a cell apart, 5e-7 deep where the field goes to several hundred.
TEST_F(DevicePrecisionTest, DoublesShowBothOfTwoSheetsAThousandthOfACellApart) {
  const Volume volume = bcc_volume({11, 11, 11}, [](const glm::dvec3& u) { return (u.x + u.y - 20.5) * (u.x + u.y - 20.5); });
  Renderer::Request request = request_for(volume, 5e-7, 64, -50.0, 15.0);
  request.scene.isosurfaces[0].opacity = 0.5;
  const Frame truth = truth_by(volume, request.scene);
  const auto both = [](const Frame& frame) { return std::count_if(frame.depth.begin(), frame.depth.end(), [&](const float& z) { return std::isfinite(z) && frame.color[4 * std::size_t(&z - frame.depth.data()) + 3] == 0.75f; }); };
  for (const Precision precision : kBoth) {
    const Frame frame = picture_of(volume, request, precision);
    const Agreement a = agreement(frame, truth);
    print(std::string("sheets, ") + precision_name(precision), a);
    std::printf("both sheets: %ld of %ld\n", long(both(frame)), long(both(truth)));
    if (precision == Precision::float32) continue;
    EXPECT_GT(both(truth), 500);
    EXPECT_EQ(both(frame), both(truth));
    EXPECT_EQ(a.strayed, 0u);
    EXPECT_LE(a.color, 1e-6);
  }
}

TEST_F(DevicePrecisionTest, DoublesShowTheSameWhateverIsSkipped) {
  std::vector<AdversarialVolume> volumes = adversarial_volumes();
  for (const std::string spline : {"bcc7", "trilinear", "tricubic"})
    for (int n = 0; n < int(volumes.size()); n += spline == "bcc7" ? 3 : 5) {
      const AdversarialVolume& c = volumes[std::size_t(n)];
      const Volume volume = spline == "bcc7" ? c.volume : cartesian_twin(c.volume);
      Renderer::Request request = view_of(c, volume, n % 3, 24);
      if (n % 2 == 1) request.scene.isosurfaces = {{c.isovalue, {1, 0, 0}, 0.5}, {0.8 * c.isovalue + 0.05, {0, 1, 0}, 0.5}};
      if (n % 5 == 4) request.scene.intersect = Intersect::march;
      Renderer::Config config;
      config.spline = spline;
      config.precision = Precision::float64;
      DeviceRenderer renderer(test_kernels(), volume, config);
      RenderStats stats;
      request.skip.structure = "none";
      const Frame truth = renderer.render(request, stats);
      int turn = 0;
      for (const std::string_view label : skip_labels()) {
        // Half of the structures each time, in turns: kernels of doubles take long to compile.
        if (label == "none" || (n + turn++) % 2 == 0) continue;
        request.skip = labelled_skip(label, {.block = 2 << (n + turn) % 4, .cell_test = (n + turn) / 2 % 2 == 0});
        SCOPED_TRACE(spline + ", " + c.name + ", " + std::string(label));
        expect_same_picture(renderer.render(request, stats), truth);
      }
    }
}

TEST_F(DevicePrecisionTest, DoublesSpanSeveralBuffersAndBandsOfRows) {
  const Volume volume = random_volume({16, 12, 10}, 3);
  Renderer::Request request = request_for(volume, 0.6, 100);
  request.skip = {.structure = "grid", .block = 8};
  Renderer::Config config;
  config.precision = Precision::float64;
  DeviceRenderer renderer(test_kernels(), volume, config, {.texel_elements = 1500, .frame_bytes = 100 * 32 * 30});
  EXPECT_EQ(renderer.variant(request).coefficient_buffers, 6);
  RenderStats stats;
  expect_same_picture(renderer.render(request, stats), picture_of(volume, request, Precision::float64));
  EXPECT_EQ(stats.precision, Precision::float64);
}

TEST_F(DevicePrecisionTest, DoublesAreRefusedByADeviceThatHasNone) {
  Renderer::Config config;
  config.precision = Precision::float64;
  const Volume volume = random_volume({3, 3, 3}, 3);
  try {
    DeviceRenderer(test_kernels(), volume, config, {.no_float64 = true});
    FAIL();
  } catch (const gpu::DeviceError& e) {
    EXPECT_THAT(e.what(), testing::StartsWith("--precision: found double, expected float: " + gpu::info(test_kernels()->device()).name + " has no"));
  }
  EXPECT_NO_THROW(DeviceRenderer(test_kernels(), volume, {}, {.no_float64 = true}));
}

TEST_F(DevicePrecisionTest, DoublesAreRefusedInAPoolOfBricks) {
  Renderer::Config config;
  config.precision = Precision::float64;
  config.pool_bytes = 1 << 20;
  const Volume volume = random_volume({3, 3, 3}, 3);
  EXPECT_THROW(DeviceRenderer(test_kernels(), std::make_shared<VolumeSource>(volume), "volume", config), InputError);
}

}  // namespace
}  // namespace quincunx

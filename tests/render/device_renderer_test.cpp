// The kernels against the double-precision reference.
#include "render/device_renderer.h"

#include <gtest/gtest.h>

#include "lattice/error.h"
#include "lattice/field.h"
#include "render/reference.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using DeviceRendererTest = DeviceTest;

Frame truth_of(const Volume& volume, const Scene& scene) {
  const Sampled sampled(volume);
  return render_reference(*sampled.spline, sampled.coefficients, scene, nullptr);
}

Frame picture_of(const Volume& volume, const Renderer::Request& request) {
  DeviceRenderer renderer(test_kernels(), volume, {});
  RenderStats stats;
  return renderer.render(request, stats);
}

World sheared_world() {
  World world;
  world.origin = {100.0, -20.0, 3.0};
  world.axes = glm::dmat3(glm::dvec3(0.8, 0.0, 0.1), glm::dvec3(0.2, 0.7, 0.0), glm::dvec3(0.0, -0.1, 1.5));
  return world;
}

/// Noise, smoothed a little so that its sheets are larger than pixels.
Volume bumpy_volume(const Extents& n, const World& world = {}) {
  return bcc_volume(n, [](const glm::dvec3& u) {
    return std::sin(0.31 * u.x + 0.2 * u.y) + std::sin(0.4 * u.y - 0.13 * u.z) * std::cos(0.23 * u.z + 0.11 * u.x);
  }, world);
}

TEST_F(DeviceRendererTest, HitsAreTheReferencesToTheRoundingOfADepth) {
  const Volume marschner_lobb = sample_field(*make_field("marschner-lobb"), LatticeKind::bcc, {32, 32, 32});
  const Volume bumpy = bumpy_volume({24, 20, 16}, sheared_world());
  const Volume noise = random_volume({12, 12, 12}, 5);
  Difference all;
  for (const auto& [volume, isovalue] : {std::pair{&marschner_lobb, 0.5}, {&bumpy, 0.2}, {&noise, 0.6}})
    for (const auto& [azimuth, elevation] : {std::pair{30.0, 20.0}, {200.0, -55.0}}) {
      const Renderer::Request request = request_for(*volume, isovalue, 128, azimuth, elevation);
      all += compare(picture_of(*volume, request), truth_of(*volume, request.scene), cell_size(volume->world));
    }
  EXPECT_GT(all.hits, 30000u);
  EXPECT_LE(all.strayed, all.hits / 10000);
  EXPECT_LE(all.depth_rms, 2e-5);
  EXPECT_LE(all.depth_p99, 1e-4);
  EXPECT_LE(all.normal_rms, 0.005);
}

TEST_F(DeviceRendererTest, TheResidualIsWithinAHundredThousandthOfACellEverywhere) {
  const Volume volume = bumpy_volume({24, 24, 24});
  const Renderer::Request request = request_for(volume, 0.2, 96);
  const Frame frame = picture_of(volume, request);
  const Sampled sampled(volume);
  const CameraFrame camera = camera_frame(request.scene.camera, 96, 96);
  double worst = 0.0;
  for (int j = 0; j < 96; ++j)
    for (int i = 0; i < 96; ++i) {
      const double z = frame.depth[j * 96 + i];
      if (!std::isfinite(z)) continue;
      const glm::dvec3 u = request.scene.camera.eye + z * pixel_direction(camera, 96, 96, i, j);
      const Jet jet = sampled.spline->evaluate(sampled.coefficients, glm::clamp(u, glm::dvec3(0.0), glm::dvec3(47.0)));
      worst = std::max(worst, std::abs(jet.value - 0.2) / glm::length(jet.gradient));
    }
  EXPECT_GT(worst, 0.0);
  // A depth near 128 has steps of 2^-17 cells to 2^-16.
  EXPECT_LE(worst, 1.5e-5);
}

TEST_F(DeviceRendererTest, SeveralSurfacesAreCompositedAsTheReferenceDoes) {
  const Volume volume = bumpy_volume({20, 20, 20});
  Renderer::Request request = request_for(volume, 0.0, 96);
  request.scene.isosurfaces = {{0.9, {0.1, 0.9, 0.2}, 1.0}, {-0.4, {0.9, 0.3, 0.1}, 0.4}, {0.3, {0.2, 0.3, 0.9}, 0.5}};
  request.scene.background = {0.2, 0.3, 0.4};
  const Difference d = compare(picture_of(volume, request), truth_of(volume, request.scene), 1.0);
  EXPECT_GT(d.hits, 2000u);
  EXPECT_LE(d.strayed, 1u);
  EXPECT_LE(d.off_color, 96u * 96u / 1000);  // the edges of surfaces behind
}

TEST_F(DeviceRendererTest, SurfacesBehindEachOtherInNoiseAreEachCountedOnce) {
  // Large values beside small slopes: the places at which two pieces know one crossing differ the most.
  const Volume volume = bcc_volume({24, 24, 24}, [random = std::mt19937(11)](const glm::dvec3& u) mutable {
    return (u.x < 30.0 ? 0.0 : 1500.0) + std::uniform_real_distribution<double>(0.0, 60.0)(random);
  });
  Renderer::Request request = request_for(volume, 0.0, 128);
  request.scene.isosurfaces = {{35.0, {0.9, 0.3, 0.1}, 0.2}, {800.0, {0.2, 0.3, 0.9}, 0.5}};
  const Difference d = compare(picture_of(volume, request), truth_of(volume, request.scene), 1.0);
  EXPECT_GT(d.hits, 5000u);
  EXPECT_LE(d.off_color, 16u);  // of 16384: layers that rays graze
}

TEST_F(DeviceRendererTest, CentralDifferencesAreTheReferences) {
  const Volume volume = bumpy_volume({16, 16, 16});
  Renderer::Request request = request_for(volume, 0.2, 64);
  request.scene.normal = Normal::central;
  request.scene.delta = 0.4;
  const Difference d = compare(picture_of(volume, request), truth_of(volume, request.scene), 1.0);
  EXPECT_GT(d.hits, 1000u);
  EXPECT_LE(d.normal_rms, 0.01);
}

TEST_F(DeviceRendererTest, MarchingLosesWhatTheReferenceLosesByMarching) {
  const Volume volume = sample_field(*make_field("marschner-lobb"), LatticeKind::bcc, {24, 24, 24});
  Renderer::Request request = request_for(volume, 0.5, 96);
  request.scene.intersect = Intersect::march;
  request.scene.step = 0.5;
  const Difference d = compare(picture_of(volume, request), truth_of(volume, request.scene), cell_size(volume.world));
  EXPECT_GT(d.hits, 1000u);
  EXPECT_LE(d.strayed, 2 + d.hits / 1000);
  EXPECT_LE(d.depth_rms, 1e-3);
}

TEST_F(DeviceRendererTest, AChangeOfIsovalueRebuildsNothingThatDoesNotDependOnIt) {
  const Volume volume = bumpy_volume({16, 16, 16});
  DeviceRenderer renderer(test_kernels(), volume, {});
  RenderStats first, second, third;
  Renderer::Request request = request_for(volume, 0.2);
  renderer.render(request, first);
  request.scene.isosurfaces[0].isovalue = 0.25;
  renderer.render(request, second);
  renderer.render(request, third);
  EXPECT_GT(first.prefilter_ms, 0.0);
  EXPECT_GT(first.bounds_ms, 0.0);
  EXPECT_EQ(second.prefilter_ms, 0.0);
  EXPECT_EQ(second.bounds_ms, 0.0);
  EXPECT_EQ(second.compile_ms, 0.0);
  EXPECT_GT(second.classify_ms, 0.0);
  EXPECT_EQ(third.classify_ms, 0.0);
  EXPECT_EQ(third.build_ms + third.cluster_ms, 0.0);
  EXPECT_EQ(third.upload_ms, 0.0);
}

TEST_F(DeviceRendererTest, AChangeOfTheTransferFunctionRebuildsNothingThatDoesNotDependOnIt) {
  const Volume volume = bumpy_volume({16, 16, 16});
  DeviceRenderer renderer(test_kernels(), volume, {});
  Renderer::Request request = request_for(volume, 0.2);
  request.skip = {.structure = "distance", .block = 4};
  request.scene.isosurfaces.clear();
  request.scene.volume = DirectVolume{};
  request.scene.volume->function = {{{0.0, glm::dvec3(1.0)}}, {{0.1, 0.0}, {0.3, 0.5}}, 1.0};
  RenderStats first, same, color, opacity;
  renderer.render(request, first);
  renderer.render(request, same);
  EXPECT_GT(first.table_ms, 0.0);
  EXPECT_GT(first.classify_ms, 0.0);
  EXPECT_EQ(same.table_ms + same.classify_ms + same.build_ms + same.upload_ms, 0.0);
  // Other colours: the table alone. A higher opacity of the same values: no other blocks.
  request.scene.volume->function.colors[0].color = {0.5, 0.2, 0.1};
  request.scene.volume->function.opacities[1].opacity = 0.7;
  renderer.render(request, color);
  EXPECT_GT(color.table_ms, 0.0);
  EXPECT_GT(color.upload_ms, 0.0);
  EXPECT_EQ(color.classify_ms + color.build_ms + color.bounds_ms + color.prefilter_ms + color.compile_ms, 0.0);
  // Other values with opacity.
  request.scene.volume->function.opacities[0].value = -0.4;
  const Frame kept = renderer.render(request, opacity);
  EXPECT_GT(opacity.table_ms, 0.0);
  EXPECT_GT(opacity.classify_ms, 0.0);
  EXPECT_EQ(opacity.bounds_ms + opacity.prefilter_ms + opacity.compile_ms, 0.0);
  expect_same_picture(kept, picture_of(volume, request));
}

TEST_F(DeviceRendererTest, AKeptRendererMakesThePictureOfAFreshOne) {
  const Volume volume = bumpy_volume({16, 16, 16});
  DeviceRenderer renderer(test_kernels(), volume, {});
  RenderStats stats;
  for (const double isovalue : {0.2, -0.5, 0.9})
    for (const int block : {4, 16}) {
      Renderer::Request request = request_for(volume, isovalue);
      request.skip.block = block;
      expect_same_picture(renderer.render(request, stats), picture_of(volume, request));
    }
}

TEST_F(DeviceRendererTest, CoefficientsOverTheLimitOfABufferSpanSeveral) {
  const Volume volume = bumpy_volume({16, 12, 10});
  Renderer::Request request = request_for(volume, 0.2);
  request.skip = {.structure = "grid", .block = 8};
  DeviceRenderer renderer(test_kernels(), volume, {}, {.texel_elements = 1500, .frame_bytes = 0});
  EXPECT_EQ(renderer.variant(request).coefficient_buffers, 6);  // 2*18*14*12 = 6048 coefficients in buffers of 2^10
  RenderStats stats;
  expect_same_picture(renderer.render(request, stats), picture_of(volume, request));
}

TEST_F(DeviceRendererTest, CoefficientsThatNoEightBuffersHoldAreRefused) {
  const Volume volume = bumpy_volume({16, 12, 10});
  DeviceRenderer renderer(test_kernels(), volume, {}, {.texel_elements = 700, .frame_bytes = 0});
  RenderStats stats;
  EXPECT_THROW(renderer.render(request_for(volume, 0.2), stats), gpu::DeviceError);
}

TEST_F(DeviceRendererTest, MoreCellsAlongAnAxisThanListsCanNumberAreRefused) {
  const Volume volume = bumpy_volume({1, 1, 32769});
  DeviceRenderer renderer(test_kernels(), volume, {});
  RenderStats stats;
  EXPECT_THROW(renderer.render(request_for(volume, 0.2), stats), InputError);
  const Volume just = bumpy_volume({1, 1, 32768});
  EXPECT_NO_THROW(DeviceRenderer(test_kernels(), just, {}).render(request_for(just, 0.2), stats));
}

TEST_F(DeviceRendererTest, PicturesOverTheLimitOfABufferAreMadeInBands) {
  const Volume volume = bumpy_volume({16, 16, 16});
  Renderer::Request request = request_for(volume, 0.2, 100);
  request.scene.cost = true;
  DeviceRenderer renderer(test_kernels(), volume, {}, {.texel_elements = 0, .frame_bytes = 100 * 16 * 30});
  RenderStats stats;
  const Frame banded = renderer.render(request, stats), whole = picture_of(volume, request);
  expect_same_picture(banded, whole);
  EXPECT_TRUE(same_bits(banded.cost, whole.cost));
}

TEST_F(DeviceRendererTest, PicturesOfAnyShapeHaveAllTheirPixels) {
  const Volume volume = bumpy_volume({16, 16, 16});
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {65, 9}, {8, 200}}) {
    Renderer::Request request = request_for(volume, 0.2);
    request.scene.width = width, request.scene.height = height;
    const Difference d = compare(picture_of(volume, request), truth_of(volume, request.scene), 1.0);
    EXPECT_EQ(d.strayed, 0u) << width << " x " << height;
    EXPECT_EQ(d.off_color, 0u) << width << " x " << height;
  }
}

TEST_F(DeviceRendererTest, StatisticsTellWhatThePictureShows) {
  const Volume volume = bumpy_volume({16, 16, 16});
  Renderer::Request request = request_for(volume, 0.2);
  request.repeat = 3;
  request.skip.block = 4;
  request.count_costs = true;
  DeviceRenderer renderer(test_kernels(), volume, {});
  RenderStats stats;
  const Frame frame = renderer.render(request, stats);
  EXPECT_EQ(stats.trace_ms.size(), 3u);
  EXPECT_EQ(stats.rays, 64u * 64u);
  EXPECT_EQ(stats.hits, std::size_t(std::count_if(frame.depth.begin(), frame.depth.end(), [](float z) { return std::isfinite(z); })));
  EXPECT_GE(stats.evaluations, stats.hits);
  EXPECT_GT(stats.active_blocks, 0u);
  EXPECT_LT(stats.active_blocks, stats.blocks);
  EXPECT_EQ(stats.device_bytes.at(0).second, 2u * 18 * 18 * 18 * 4);
}

TEST_F(DeviceRendererTest, BadRequestsNameTheirFlag) {
  const Volume volume = bumpy_volume({4, 4, 4});
  DeviceRenderer renderer(test_kernels(), volume, {});
  RenderStats stats;
  const auto message = [&](const Renderer::Request& request) -> std::string {
    try {
      renderer.render(request, stats);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  Renderer::Request request = request_for(volume, 0.2);
  request.skip.block = 12;
  EXPECT_NE(message(request).find("--block: found 12"), std::string::npos);
  request = request_for(volume, 0.2);
  request.skip.structure = "magic";
  EXPECT_NE(message(request).find("magic"), std::string::npos);
  request = request_for(volume, 0.2);
  request.scene.isosurfaces[0].opacity = 0.0;
  EXPECT_NE(message(request).find("--opacity"), std::string::npos);
}

}  // namespace
}  // namespace quincunx

#include "render/voxel_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "accel/particles.h"
#include "accel/volume_voxels.h"
#include "device_fixture.h"
#include "lattice/target_grid.h"
#include "render/ray.h"
#include "render/reference_voxels.h"
#include "render/voxel_table.h"
#include "shaders/shaders.h"

namespace quincunx {
namespace {

std::shared_ptr<gpu::Device> test_device() { return {test_kernels(), &test_kernels()->device()}; }

Volume volume_of(LatticeKind lattice, const Extents& n, const std::function<double(const glm::dvec3&)>& f, const World& world = {}) {
  return lattice == LatticeKind::bcc ? bcc_volume(n, f, world) : cartesian_volume(n, f, world);
}

/// A scene of the volume alone, nothing of which ends a ray early.
Scene scene_of(const Voxels& voxels, const TransferFunction& function, int size = 40, Orbit orbit = {30.0, 20.0, 1.0}) {
  Scene scene;
  scene.width = size, scene.height = size - 3;
  scene.volume = DirectVolume{};
  scene.volume->function = function;
  scene.volume->termination = 0.0;
  scene.camera = framing_camera(voxels.lattice, voxels.extents, voxels.world, orbit, scene.width, scene.height);
  return scene;
}

/// Of one opacity for all values, white.
TransferFunction constant(double opacity, double unit = 0.0) { return {{{0.0, glm::dvec3(1.0)}}, {{0.0, opacity}, {1.0, opacity}}, unit}; }
/// Colours and opacities that go along with the value.
TransferFunction voxel_ramp() { return {{{0.0, {1.0, 0.1, 0.0}}, {1.0, {0.0, 0.3, 1.0}}}, {{0.2, 0.0}, {0.6, 0.5}, {1.0, 0.05}}, 0.0}; }

Frame device_frame(const Voxels& voxels, const Scene& scene, const VoxelRenderer::Config& config = {}, RenderStats* stats = nullptr) {
  VoxelRenderer renderer(test_device(), voxels, config);
  RenderStats unused;
  return renderer.render({.scene = scene, .skip = {}, .repeat = 1, .count_costs = false}, stats ? *stats : unused);
}

/// The length of the ray of each pixel inside the domain, world units; 0 where there is none.
std::vector<double> lengths(const Voxels& voxels, const Scene& scene) {
  const CameraFrame frame = camera_frame(scene.camera, scene.width, scene.height);
  const RaySpace space = ray_space(voxels.lattice, voxels.extents, voxels.world, scene.camera.eye);
  std::vector<double> result;
  for (int j = 0; j < scene.height; ++j)
    for (int i = 0; i < scene.width; ++i) {
      const auto ray = clip_ray(space, pixel_direction(frame, scene.width, scene.height, i, j));
      result.push_back(ray ? ray->length * ray->scale : 0.0);
    }
  return result;
}

/// The largest difference of any channel of colour, and how many pixels differ by more than `small`.
struct VoxelOff {
  double most = 0.0;
  std::size_t pixels = 0;
};
VoxelOff off(const Frame& a, const Frame& b, double small) {
  VoxelOff result;
  for (std::size_t p = 0; p < a.depth.size(); ++p) {
    double worst = 0.0;
    for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(double(a.color[4 * p + c]) - b.color[4 * p + c]));
    result.most = std::max(result.most, worst);
    result.pixels += worst > small;
  }
  return result;
}

/// A colour of floats is composited of some ten to hundred voxels, each rounded by about 2^-23. Where a ray crosses a plane is off by some 2^-23 of the coordinates over
/// the slope at which it crosses: along a ray nearly inside of a plane by up to a hundredth of a cell, by which a voxel's neighbour takes its place.
void expect_as_in_doubles(const Voxels& voxels, const Scene& scene) {
  const Frame truth = render_reference_voxels(voxels, scene), frame = device_frame(voxels, scene);
  const VoxelOff found = off(frame, truth, 2e-5);
  EXPECT_LT(found.most, 2e-3);
  EXPECT_LE(found.pixels, truth.depth.size() / 100);
  EXPECT_GT(count_hits(truth), truth.depth.size() / 10);
  std::size_t far = 0;
  for (std::size_t p = 0; p < truth.depth.size(); ++p)
    far += std::isfinite(truth.depth[p]) != std::isfinite(frame.depth[p]) || (std::isfinite(truth.depth[p]) && std::abs(truth.depth[p] - frame.depth[p]) > 1e-3 * voxels.unit);
  EXPECT_LE(far, truth.depth.size() / 100);
}

using VoxelRendering = DeviceTest;

// ---- what the reference promises ----

TEST(VoxelReference, OfOneDensityHidesByTheLengthOfTheRayWhateverTheVoxels) {
  constexpr double opacity = 0.07;
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc}) {
    World world;
    world.axes = glm::dmat3(1.5, 0.0, 0.0, 0.25, 2.0, 0.0, 0.0, 0.5, 1.75);
    const Volume volume = volume_of(lattice, {9, 8, 6}, [](const glm::dvec3&) { return 0.5; }, world);
    const TargetGrid fine = grid_of_extents(volume, lattice, {14, 12, 11});
    const Volume finer = volume_of(lattice, fine.extents, [](const glm::dvec3&) { return 0.5; }, fine.world);
    for (const Volume* of : {&volume, &finer}) {
      for (const bool merged : {false, true}) {
        VoxelConfig config;
        if (merged) config.deviation = 0.0;
        Voxels voxels = volume_voxels(*of, config);
        voxels.unit = cell_length(world);
        const Scene scene = scene_of(voxels, constant(opacity));
        const Frame frame = render_reference_voxels(voxels, scene);
        const std::vector<double> length = lengths(voxels, scene);
        for (std::size_t p = 0; p < length.size(); ++p)
          EXPECT_NEAR(frame.color[4 * p + 3], 1.0 - std::pow(1.0 - opacity, length[p] / voxels.unit), 1e-7) << p;
      }
    }
  }
}

TEST(VoxelReference, TakesTheUnitOfTheTransferFunction) {
  const Volume volume = volume_of(LatticeKind::cartesian, {8, 8, 8}, [](const glm::dvec3&) { return 0.5; });
  const Voxels voxels = volume_voxels(volume, {});
  const Scene scene = scene_of(voxels, constant(0.3, 2.5));
  const Frame frame = render_reference_voxels(voxels, scene);
  const std::vector<double> length = lengths(voxels, scene);
  for (std::size_t p = 0; p < length.size(); ++p) EXPECT_NEAR(frame.color[4 * p + 3], 1.0 - std::pow(0.7, length[p] / 2.5), 1e-7);
}

TEST(VoxelReference, OfASphereHidesByItsChordAndIsLitByItsNormal) {
  const std::vector<Particle> particles{{{1.0, 2.0, 3.0}, 2.0, 0.5}};
  const Voxels voxels = particle_voxels(particles, "particles");
  Scene scene = scene_of(voxels, constant(0.4));
  scene.ambient = 0.25;
  const Frame frame = render_reference_voxels(voxels, scene);
  const CameraFrame camera = camera_frame(scene.camera, scene.width, scene.height);
  for (int j = 0; j < scene.height; ++j)
    for (int i = 0; i < scene.width; ++i) {
      const glm::dvec3 d = pixel_direction(camera, scene.width, scene.height, i, j), to = particles[0].centre - scene.camera.eye;
      const double off = glm::length(to - glm::dot(to, d) * d);
      const double chord = off < 2.0 ? 2.0 * std::sqrt(4.0 - off * off) : 0.0;
      const double alpha = 1.0 - std::pow(0.6, chord / 2.0), facing = chord / 4.0;  // the cosine where it enters
      const std::size_t p = std::size_t(j) * std::size_t(scene.width) + std::size_t(i);
      EXPECT_NEAR(frame.color[4 * p + 3], alpha, 1e-6);
      EXPECT_NEAR(frame.color[4 * p], alpha * (0.25 + 0.75 * facing), 1e-6);
    }
}

TEST(VoxelReference, PassesVoxelsFrontToBack) {
  // A red half in front of a blue one, seen along +y, and from behind.
  const Volume volume = volume_of(LatticeKind::cartesian, {6, 6, 6}, [](const glm::dvec3& u) { return u.y < 2.5 ? 0.0 : 1.0; });
  const Voxels voxels = volume_voxels(volume, {});
  TransferFunction function = constant(0.6);
  function.colors = {{0.0, {1.0, 0.0, 0.0}}, {1.0, {0.0, 0.0, 1.0}}};
  for (const double azimuth : {0.0, 180.0}) {
    Scene scene = scene_of(voxels, function, 9, {azimuth, 0.0, 1.0});
    scene.volume->shade = false;
    const Frame frame = render_reference_voxels(voxels, scene);
    const std::size_t middle = 4 * (3 * 9 + 4);
    const double front = 1.0 - std::pow(0.4, 2.5), red = frame.color[middle], blue = frame.color[middle + 2];
    EXPECT_NEAR(azimuth == 0.0 ? red : blue, front, 0.02);
    EXPECT_NEAR(azimuth == 0.0 ? blue : red, (1.0 - front) * front, 0.02);
  }
}

TEST(VoxelTable, BeginsWhereTheTransferFunctionGivesOpacity) {
  EXPECT_EQ(least_visible(voxel_ramp()), std::nextafter(0.2, 1.0));
  EXPECT_EQ(least_visible(constant(0.5)), -INFINITY);
  EXPECT_EQ(least_visible(constant(0.0)), INFINITY);
}

// ---- the device ----

TEST_F(VoxelRendering, OfOneDensityHidesByTheLengthOfTheRayOnTheDevice) {
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc}) {
    for (const bool merged : {false, true}) {
      const Volume volume = volume_of(lattice, {9, 8, 6}, [](const glm::dvec3&) { return 0.5; });
      VoxelConfig config;
      if (merged) config.deviation = 0.0;
      const Voxels voxels = volume_voxels(volume, config);
      const Scene scene = scene_of(voxels, constant(0.07));
      const Frame frame = device_frame(voxels, scene);
      const std::vector<double> length = lengths(voxels, scene);
      // The ray's ends are off by 2^-23 of the coordinates over its slope, the product of some fifty transmittances by 2^-23 each.
      for (std::size_t p = 0; p < length.size(); ++p) EXPECT_NEAR(frame.color[4 * p + 3], 1.0 - std::pow(0.93, length[p]), 2e-5) << p;
    }
  }
}

TEST_F(VoxelRendering, IsThatOfTheReference) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  World world;
  world.origin = {10.0, -4.0, 2.0};
  world.axes = glm::dmat3(1.5, 0.0, 0.0, 0.25, 2.0, 0.0, 0.0, 0.5, 1.75);
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc}) {
    // Smooth in one part, so that some is merged, random in the other, and some of it below the minimum.
    const Volume volume = volume_of(lattice, {13, 11, 9}, [&](const glm::dvec3& u) { return u.x < 6.0 ? 0.5 + 0.02 * u.y : uniform(random); }, world);
    for (const std::optional<double> deviation : {std::optional<double>(), std::optional<double>(0.05), std::optional<double>(0.4)}) {
      SCOPED_TRACE(testing::Message() << lattice_name(lattice) << " " << deviation.value_or(-1.0));
      const Voxels voxels = volume_voxels(volume, {.minimum = least_visible(voxel_ramp()), .deviation = deviation});
      Scene scene = scene_of(voxels, voxel_ramp());
      scene.background = {0.1, 0.2, 0.3};
      expect_as_in_doubles(voxels, scene);
    }
  }
}

TEST_F(VoxelRendering, IsThatOfTheReferenceHoweverItIsLitFromInsideAndWithoutLight) {
  const Volume volume = volume_of(LatticeKind::cartesian, {12, 12, 12}, [](const glm::dvec3& u) { return 0.5 + 0.5 * std::sin(u.x) * std::cos(0.7 * u.y + u.z); });
  const Voxels voxels = volume_voxels(volume, {.minimum = 0.3, .deviation = 0.1});
  Scene scene = scene_of(voxels, voxel_ramp());
  scene.volume->shade = false;
  expect_as_in_doubles(voxels, scene);
  scene.volume->modulate_from = 0.1, scene.volume->modulate_to = 0.5;
  expect_as_in_doubles(voxels, scene);
  scene.volume->shade = true;
  scene.camera = {.eye = {5.3, 5.2, 5.1}, .target = {11.0, 8.0, 3.0}, .up = {0.0, 0.0, 1.0}, .fov = 70.0};
  expect_as_in_doubles(voxels, scene);
}

TEST_F(VoxelRendering, OfSpheresThatOverlapIsThatOfTheReference) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Particle> particles;
  for (int n = 0; n < 300; ++n) particles.push_back({{3.0 * uniform(random), 4.0 * uniform(random), 2.0 * uniform(random)}, 0.05 + 0.3 * uniform(random), uniform(random)});
  const Voxels voxels = particle_voxels(particles, "particles");
  Scene scene = scene_of(voxels, voxel_ramp());
  expect_as_in_doubles(voxels, scene);
  scene.camera = {.eye = {1.5, 2.0, 1.0}, .target = {3.0, 3.0, 1.2}, .up = {0.0, 0.0, 1.0}, .fov = 60.0};
  expect_as_in_doubles(voxels, scene);
}

TEST_F(VoxelRendering, EndsRaysEarlyWithinWhatTheyLetThrough) {
  const Volume volume = volume_of(LatticeKind::cartesian, {12, 12, 12}, [](const glm::dvec3& u) { return 0.5 + 0.5 * std::sin(u.x + u.y) * std::cos(u.z); });
  const Voxels voxels = volume_voxels(volume, {.minimum = 0.3, .deviation = {}});
  Scene scene = scene_of(voxels, voxel_ramp());
  scene.cost = true;
  const Frame whole = device_frame(voxels, scene);
  scene.volume->termination = 0.1;
  const Frame ended = device_frame(voxels, scene);
  EXPECT_LT(off(whole, ended, 1.0).most, 0.1 + 1e-5);
  EXPECT_LT(cost_sums(ended).intervals, cost_sums(whole).intervals);
}

// A voxel is passed at times that are the ray's alone, and in an order that is theirs.
TEST_F(VoxelRendering, IsTheSameBitForBitWhateverTheTreeAndTheBands) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Volume volume = volume_of(LatticeKind::bcc, {9, 9, 9}, [&](const glm::dvec3& u) { return u.x < 6.0 ? 0.5 + 0.02 * u.y : uniform(random); });
  const Voxels voxels = volume_voxels(volume, {.minimum = 0.3, .deviation = 0.05});
  const Scene scene = scene_of(voxels, voxel_ramp());
  const Frame frame = device_frame(voxels, scene);
  for (const int leaf_size : {2, 7}) expect_same_picture(device_frame(voxels, scene, {.leaf_size = leaf_size}), frame);
  expect_same_picture(device_frame(voxels, scene, {.frame_bytes = 16 * 40 * 8}), frame);
}

TEST_F(VoxelRendering, OfNothingIsItsBackground) {
  const Volume volume = volume_of(LatticeKind::cartesian, {4, 4, 4}, [](const glm::dvec3&) { return 0.0; });
  const Voxels voxels = volume_voxels(volume, {.minimum = 0.5, .deviation = {}});
  Scene scene = scene_of(voxels, voxel_ramp());
  scene.background = {0.25, 0.5, 0.75};
  const Frame frame = device_frame(voxels, scene);
  EXPECT_EQ(count_hits(frame), 0u);
  EXPECT_EQ(frame.color[0], 0.25f);
}

TEST_F(VoxelRendering, TellsWhatItTakes) {
  const Volume volume = volume_of(LatticeKind::cartesian, {8, 8, 8}, [](const glm::dvec3& u) { return u.x < 4.0 ? 0.0 : 0.6; });
  const Voxels voxels = volume_voxels(volume, {.minimum = 0.5, .deviation = {}});
  RenderStats stats;
  VoxelRenderer renderer(test_device(), voxels, {});
  renderer.render({.scene = scene_of(voxels, voxel_ramp()), .skip = {}, .repeat = 2, .count_costs = true}, stats);
  ASSERT_TRUE(stats.voxels.has_value());
  EXPECT_EQ(stats.voxels->voxels, 256u);
  EXPECT_EQ(stats.voxels->samples, 512u);
  EXPECT_EQ(stats.voxels->grid_bytes, 2048u);
  EXPECT_EQ(stats.voxels->leaf_bytes, 8u * 256u);
  EXPECT_EQ(stats.voxels->place_bytes, 8u * 256u);
  EXPECT_EQ(stats.voxels->node_bytes, 8u * stats.voxels->nodes);
  EXPECT_GE(stats.voxels->nodes, 2u * 256u - 1u);
  EXPECT_GE(stats.voxels->depth, 9);
  EXPECT_EQ(stats.trace_ms.size(), 2u);
  EXPECT_GT(stats.steps, stats.evaluations);
  EXPECT_GE(stats.evaluations, stats.intervals);
  EXPECT_GT(stats.intervals, 0u);
}

// ---- the kernel ----

TEST(VoxelKernel, ReadsItsParametersWhereCppPutsThem) {
  const gpu::Reflection reflection = gpu::reflect(gpu::compile([](std::string_view name) { return shader_file(name); }, voxel_kernel({.modulated = true})));
  std::map<std::string, std::size_t> offsets;
  for (const gpu::BlockMember& m : reflection.members)
    if (m.block == "voxelUniforms") offsets[m.name] = m.offset;
#define MEMBER(name) {"all." #name, offsetof(VoxelParameters, name)}
  const std::map<std::string, std::size_t> expected{MEMBER(root_low), MEMBER(root_step), MEMBER(edge), MEMBER(counts), MEMBER(modulation)};
#undef MEMBER
  EXPECT_EQ(offsets, expected);
}

TEST(VoxelKernel, BindsWhatEachVariantNeedsAndNothingElse) {
  for (int bits = 0; bits < 16; ++bits) {
    const VoxelVariant variant{.spheres = (bits & 1) != 0, .lit = (bits & 2) != 0, .modulated = (bits & 4) != 0, .cost = (bits & 8) != 0};
    const gpu::Reflection reflection = gpu::reflect(gpu::compile([](std::string_view name) { return shader_file(name); }, voxel_kernel(variant)));
    std::set<std::string> bound, expected{"uniforms", "voxelUniforms", "voxelNodes", "voxelData", "voxelPlaces", "transferTable", "Color", "Hit"};
    for (const gpu::Binding& b : reflection.bindings) bound.insert(b.name);
    if (variant.cost) expected.insert("Cost");
    EXPECT_EQ(bound, expected) << bits;
  }
}

}  // namespace
}  // namespace quincunx

// Coefficients of 16 and 8 bits on the device: pictures are those of the coefficients as they are stored.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "accel/structure.h"
#include "lattice/error.h"
#include "lattice/field.h"
#include "render/reference_renderer.h"
#include "tests/render/adversarial_volumes.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr Storage kPacked[] = {Storage::float16, Storage::unorm16, Storage::unorm8};

/// Hills from 85 to 130 or so, and noise of a tenth of that.
Volume hills(LatticeKind lattice, const Extents& n) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> noise(-2.0, 2.0);
  const double step = lattice == LatticeKind::bcc ? 1.0 : 1.6;
  Volume volume{lattice, n, {}, std::vector<float>{}, {}};
  for (int c = 0; c < coset_count(lattice); ++c)
    for (std::int64_t k = 0; k < n.z; ++k)
      for (std::int64_t j = 0; j < n.y; ++j)
        for (std::int64_t i = 0; i < n.x; ++i) {
          const glm::dvec3 u = step * (double(lattice_step(lattice)) * glm::dvec3(i, j, k) + double(c));
          const double value = 107.0 + 12.0 * std::sin(0.4 * u.x + 0.2) * std::cos(0.35 * u.y) + 8.0 * std::sin(0.3 * u.z) + noise(random);
          std::get<std::vector<float>>(volume.samples).push_back(float(value));
        }
  return volume;
}

constexpr double kSummit = 119.3;  // about the hills' tops alone

/// A spline that can be intersected exactly, and a small volume of its lattice.
struct StoredCase {
  std::string spline;
  Volume volume;
};
std::vector<StoredCase> cases() {
  std::vector<StoredCase> all;
  for (const std::string_view spline : spline_names()) {
    if (!make_spline(spline)->polynomial()) continue;
    const LatticeKind lattice = make_spline(spline)->lattice();
    all.push_back({std::string(spline), hills(lattice, lattice == LatticeKind::bcc ? Extents(12, 11, 10) : Extents(17, 15, 16))});
  }
  return all;
}

DirectVolume glow_of_bytes() {
  DirectVolume volume;
  volume.function.colors = {{90.0, {0.1, 0.3, 0.9}}, {130.0, {0.9, 0.5, 0.1}}};
  volume.function.opacities = {{114.0, 0.0}, {117.0, 0.5}, {119.0, 0.0}, {122.0, 0.0}, {124.0, 0.8}};
  return volume;
}

class DeviceStorageTest : public DeviceTest {
 protected:
  static Renderer::Config config_of(const std::string& spline, Storage storage) {
    Renderer::Config config;
    config.spline = spline;
    config.storage = storage;
    return config;
  }
  static Frame picture(const Volume& volume, const Renderer::Config& config, const Renderer::Request& request, RenderStats& stats, const DeviceLimits& limits = {}) {
    DeviceRenderer renderer(test_kernels(), volume, config, limits);
    return renderer.render(request, stats);
  }
  static Frame reference(const Volume& volume, const Renderer::Config& config, const Renderer::Request& request) {
    ReferenceRenderer renderer(volume, config);
    RenderStats stats;
    return renderer.render(request, stats);
  }
  /// A renderer of bricks of `edge` cells, with so many slots of them.
  static DeviceRenderer pooled(const StoredCase& c, Storage storage, int edge, std::uint64_t slots, const DeviceLimits& limits = {}) {
    Renderer::Config config = config_of(c.spline, storage);
    config.brick = edge;
    const BrickLayout layout(c.volume.lattice, c.volume.extents, make_spline(c.spline)->apron(), edge, storage);
    config.pool_bytes = std::min(slots, std::uint64_t(layout.count())) * layout.slot_bytes();
    return {test_kernels(), std::make_shared<VolumeSource>(c.volume), "hills.nrrd", config, limits};
  }
  static std::uint64_t bytes_of(const RenderStats& stats, const std::string& purpose) {
    for (const auto& [name, bytes] : stats.device_bytes)
      if (name == purpose) return bytes;
    return 0;
  }
};

TEST_F(DeviceStorageTest, SurfacesAreTheReferencesOfTheStoredCoefficients) {
  for (const Storage storage : kPacked) {
    Difference all;
    std::size_t moved = 0;
    for (const StoredCase& c : cases()) {
      SCOPED_TRACE(c.spline + ", " + storage_name(storage));
      const Renderer::Config config = config_of(c.spline, storage);
      const Renderer::Request request = request_for(c.volume, 109.7, 64);
      RenderStats stats;
      const Frame found = picture(c.volume, config, request, stats);
      all += compare(found, reference(c.volume, config, request), 1.0);
      const Difference d = compare(found, reference(c.volume, config_of(c.spline, Storage::float32), request), 1.0);
      moved += d.depth_rms > 2e-5;
      EXPECT_EQ(stats.storage, storage_name(storage));
      EXPECT_EQ(bytes_of(stats, "coefficients"),
                storage_bytes(storage) * coefficient_count(c.volume.lattice, c.volume.extents, make_spline(c.spline)->apron()));
    }
    EXPECT_GT(all.hits, 3000u);
    EXPECT_LE(all.strayed, all.hits / 1000);
    EXPECT_LE(all.depth_rms, 2e-5);
    EXPECT_LE(all.depth_p99, 1e-4);
    EXPECT_LE(all.normal_rms, 0.01);
    EXPECT_EQ(moved, cases().size()) << storage_name(storage) << " shows what 32-bit floats show";
  }
}

TEST_F(DeviceStorageTest, VolumesAreTheReferencesOfTheStoredCoefficients) {
  for (const Storage storage : kPacked)
    for (const StoredCase& c : cases()) {
      SCOPED_TRACE(c.spline + ", " + storage_name(storage));
      Renderer::Request request = request_for(c.volume, 0.0, 32);
      request.scene.isosurfaces.clear();
      request.scene.volume = glow_of_bytes();
      request.scene.volume->modulate_from = 0.5, request.scene.volume->modulate_to = 3.0;
      const Renderer::Config config = config_of(c.spline, storage);
      RenderStats stats;
      const Difference d = compare(picture(c.volume, config, request, stats), reference(c.volume, config, request), 1.0);
      EXPECT_GT(d.hits, 100u);
      EXPECT_EQ(d.off_color, 0u);
    }
}

TEST_F(DeviceStorageTest, NoStructureChangesAPixel) {
  const std::vector<StoredCase> all = cases();
  std::size_t n = 0;
  for (const Storage storage : kPacked) {
    const StoredCase& c = all[std::size_t(storage) % all.size()];
    DeviceRenderer renderer(test_kernels(), c.volume, config_of(c.spline, storage));
    for (const bool seen_as_volume : {false, true}) {
      Renderer::Request request = request_for(c.volume, kSummit, 32, 200.0, -30.0);
      if (seen_as_volume) request.scene.isosurfaces.clear(), request.scene.volume = glow_of_bytes();
      request.skip = {.structure = "none"};
      RenderStats stats;
      const Frame truth = renderer.render(request, stats);
      EXPECT_GT(stats.hits, 100u);
      for (const std::string_view label : skip_labels()) {
        // Each storage sees others, a volume fewer.
        if (label == "none" || ++n % (seen_as_volume ? 7 : 3) != 0) continue;
        SCOPED_TRACE(c.spline + ", " + storage_name(storage) + ", " + std::string(label));
        request.skip = labelled_skip(label, {.block = 2, .cell_test = n % 2 == 0});
        expect_same_picture(renderer.render(request, stats), truth);
        EXPECT_LT(stats.active_blocks, stats.blocks);
      }
    }
  }
}

TEST_F(DeviceStorageTest, TheDeviceReadsEveryNumberAsItIsSupposedTo) {
  // spline/storage.cpp supposes it: 16-bit floats exactly, the others within two roundings.
  const char* text = R"(#version 460
layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer texels;
layout(std430, binding = 1) writeonly buffer Numbers { float numbers[]; };
void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n < numbers.length()) numbers[n] = texelFetch(texels, int(n)).r;
})";
  gpu::Device& device = test_kernels()->device();
  const gpu::Pipeline pipeline = gpu::create_pipeline(device, gpu::compile(device, [text](std::string_view) { return std::string_view(text); }, {"read.comp", {}}));
  for (const Storage storage : kPacked) {
    std::vector<std::uint16_t> codes;
    std::vector<std::byte> packed;
    for (int n = 0; n < (storage == Storage::unorm8 ? 256 : 65536); ++n) {
      const std::uint16_t code = std::uint16_t(n);
      if (storage_bits(storage, stored_number(storage, code)) != code) continue;  // no number of the format
      codes.push_back(code);
      packed.push_back(std::byte(code & 255));
      if (storage != Storage::unorm8) packed.push_back(std::byte(code >> 8));
    }
    const gpu::Buffer texels = gpu::create_filled(device, packed, gpu::BufferUse::texel, "texels", CoefficientFormat{.storage = storage}.texels());
    const gpu::Buffer numbers = gpu::create_buffer(device, codes.size() * sizeof(float), gpu::BufferUse::storage, "numbers");
    gpu::dispatch(device, pipeline, {{"texels", texels}, {"Numbers", numbers}}, {}, std::uint32_t(codes.size() + 63) / 64);
    std::vector<float> read(codes.size());
    gpu::download(device, numbers, std::as_writable_bytes(std::span(read)));
    EXPECT_GE(codes.size(), storage == Storage::unorm8 ? 256u : 61440u);
    for (std::size_t n = 0; n < codes.size(); ++n) {
      const double number = storage == Storage::float16 ? double(stored_number(storage, codes[n])) : double(codes[n]) / (storage == Storage::unorm8 ? 255.0 : 65535.0);
      ASSERT_LE(std::abs(double(read[n]) - number), storage == Storage::float16 ? 0.0 : 0x1p-23 * number) << storage_name(storage) << ", code " << codes[n];
    }
  }
}

TEST_F(DeviceStorageTest, SeveralBuffersShowWhatOneDoes) {
  const StoredCase c = cases().front();
  const Renderer::Request request = request_for(c.volume, 109.7, 32);
  for (const Storage storage : kPacked) {
    RenderStats stats;
    const Frame one = picture(c.volume, config_of(c.spline, storage), request, stats);
    const Frame several = picture(c.volume, config_of(c.spline, storage), request, stats, {.texel_elements = 1100});
    expect_same_picture(several, one);
    EXPECT_EQ(bytes_of(stats, "coefficients") % (1024 * storage_bytes(storage)), 0u);
  }
}

TEST_F(DeviceStorageTest, APoolShowsTheSameWithAnyNumberOfSlotsAndWhateverIsSkipped) {
  for (const StoredCase& c : cases())
    for (const Storage storage : kPacked)
      for (const bool seen_as_volume : {false, true}) {
        if (c.spline != "bcc7" && (storage != Storage::unorm8 || seen_as_volume)) continue;  // kernels are the same, their compilation takes long
        SCOPED_TRACE(c.spline + ", " + storage_name(storage));
        Renderer::Request request = request_for(c.volume, kSummit, 24);
        if (seen_as_volume) request.scene.isosurfaces.clear(), request.scene.volume = glow_of_bytes();
        DeviceRenderer roomy = pooled(c, storage, 8, 1000), cramped = pooled(c, storage, 8, 2);
        RenderStats stats;
        request.skip = {.structure = "none"};
        const Frame truth = roomy.render(request, stats);
        EXPECT_GT(stats.hits, 50u);
        EXPECT_EQ(stats.storage, storage_name(storage));
        expect_same_picture(cramped.render(request, stats), truth);
        EXPECT_GT(stats.bricks.evictions, 0u);
        const BrickLayout layout(c.volume.lattice, c.volume.extents, make_spline(c.spline)->apron(), 8);
        EXPECT_EQ(stats.bricks.loaded_bytes * 4, stats.bricks.loads * layout.slot_bytes() * storage_bytes(storage));
        for (const int block : {1, 2, 4}) {
          request.skip = {.structure = "grid", .block = block};
          expect_same_picture(roomy.render(request, stats), truth);
          EXPECT_LT(stats.active_blocks, stats.blocks);
        }
      }
}

TEST_F(DeviceStorageTest, SkippingChangesNoPixelOfVolumesMadeToBreakIt) {
  // Spikes beside constants: what one brick rounds by a thousand values its neighbour keeps.
  std::size_t n = 0;
  for (const auto& [name, volume, isovalue] : adversarial_volumes()) {
    SCOPED_TRACE(name);
    const StoredCase c{"bcc7", volume};
    const bool see_through = ++n % 2 == 0;
    DeviceRenderer whole(test_kernels(), volume, config_of(c.spline, Storage::unorm8)), bricks = pooled(c, Storage::unorm8, 4, 1000);
    for (DeviceRenderer* renderer : {&whole, &bricks}) {
      Renderer::Request request = request_for(volume, isovalue, 24, 75.0, 35.0);
      request.scene.isosurfaces.front().opacity = see_through ? 0.4 : 1.0;
      request.skip = {.structure = "none"};
      RenderStats stats;
      const Frame truth = renderer->render(request, stats);
      for (const int block : {1, 4}) {
        request.skip = {.structure = "grid", .block = block};
        expect_same_picture(renderer->render(request, stats), truth);
      }
    }
  }
}

/// The greatest distance between the depths of two pictures of one closed surface, and the pixels that only one of them hits.
struct Apart {
  double most = 0.0;
  std::size_t lost = 0, hits = 0;
};
Apart apart(const Frame& a, const Frame& b) {
  Apart result;
  for (std::size_t p = 0; p < a.depth.size(); ++p) {
    const bool in_a = std::isfinite(a.depth[p]), in_b = std::isfinite(b.depth[p]);
    result.hits += in_b;
    result.lost += in_a != in_b;
    if (in_a && in_b) result.most = std::max(result.most, double(std::abs(a.depth[p] - b.depth[p])));
  }
  return result;
}

TEST_F(DeviceStorageTest, ASurfaceThroughManyBricksHasNoHolesAndIsNearTheUnroundedOne) {
  for (const std::string spline : {"bcc7", "trilinear", "tricubic"}) {
    // A slope across all rays, from -30 to 30 in x: each ray meets it once, and every value near 0 differs from brick to brick.
    StoredCase c{spline, hills(make_spline(spline)->lattice(), make_spline(spline)->lattice() == LatticeKind::bcc ? Extents(16, 16, 16) : Extents(31, 31, 31))};
    const double step = lattice_step(c.volume.lattice);
    auto& samples = std::get<std::vector<float>>(c.volume.samples);
    const Extents n = c.volume.extents;
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const glm::dvec3 u = step * glm::dvec3(std::int64_t(s) % n.x, std::int64_t(s) / n.x % n.y, std::int64_t(s) / (n.x * n.y) % n.z) + double(std::int64_t(s) >= n.x * n.y * n.z);
      samples[s] = float(2.0 * u.x - 30.0 + 6.0 * std::sin(0.7 * u.y) + 5.0 * std::cos(0.5 * u.z));
    }
    Renderer::Request request = request_for(c.volume, 0.1, 128);
    request.scene.camera.eye = {-120.0, 15.0, 16.0};
    request.scene.camera.target = {15.0, 15.0, 15.0};
    request.scene.camera.fov = 6.0;
    RenderStats stats;
    const Frame truth = picture(c.volume, config_of(spline, Storage::float32), request, stats);
    EXPECT_EQ(stats.hits, stats.rays) << "the surface fills the picture";
    for (const Storage storage : kPacked) {
      SCOPED_TRACE(spline + ", " + storage_name(storage));
      request.skip = {.structure = "grid", .block = 4, .cell_test = false};
      const Apart whole = apart(picture(c.volume, config_of(spline, storage), request, stats), truth);
      const Apart bricks = apart(pooled(c, storage, 4, 1000).render(request, stats), truth);
      EXPECT_EQ(bricks.lost, 0u);
      EXPECT_EQ(whole.lost, 0u);
      // Values are off by half a step, and change by about 2 a cell along rays: of all the volume's 80, and of a brick's 30 or so.
      const double half_step = storage == Storage::unorm8 ? 0.5 / 255 : storage == Storage::unorm16 ? 0.5 / 65535 : 0x1p-13;
      EXPECT_LE(whole.most, 100.0 * half_step / 1.0 + 2e-4);
      EXPECT_LE(bricks.most, 40.0 * half_step / 1.0 + 2e-4);
      EXPECT_GT(whole.most, 0.0);
    }
  }
}

TEST_F(DeviceStorageTest, IsRefusedWhereTheDeviceCannotReadItOrKernelsComputeInDoubles) {
  const StoredCase c = cases().front();
  const auto refusal = [&](Renderer::Config config, const DeviceLimits& limits) -> std::string {
    try {
      DeviceRenderer(test_kernels(), c.volume, config, limits);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(refusal(config_of(c.spline, Storage::unorm16), {.no_small_texels = true}), AllOf(HasSubstr("--storage: found unorm16"), HasSubstr("expected float32")));
  EXPECT_EQ(refusal(config_of(c.spline, Storage::float32), {.no_small_texels = true}), "");
  Renderer::Config doubles = config_of(c.spline, Storage::float16);
  doubles.precision = Precision::float64;
  EXPECT_THAT(refusal(doubles, {}), AllOf(HasSubstr("--storage: found float16"), HasSubstr("--precision double"), HasSubstr("expected float32")));
}

TEST_F(DeviceStorageTest, IsExplained) {
  const StoredCase c = cases().front();
  const Renderer::Request request = request_for(c.volume, 109.7, 8);
  for (const Storage storage : kStorages) {
    DeviceRenderer renderer(test_kernels(), c.volume, config_of(c.spline, storage));
    bool found = false;
    for (const Feature& feature : renderer.explain(request)) {
      if (feature.name != "small coefficients") continue;
      found = true;
      EXPECT_EQ(feature.compiled, storage != Storage::float32);
      EXPECT_THAT(feature.why, AllOf(HasSubstr(storage_name(storage)), HasSubstr(std::to_string(storage_bytes(storage)) + " bytes")));
    }
    EXPECT_TRUE(found);
  }
}

}  // namespace
}  // namespace quincunx

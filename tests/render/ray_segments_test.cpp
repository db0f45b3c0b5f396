// The lists of segments that rays get before they enter.
#include <gtest/gtest.h>

#include "accel/structure.h"
#include "render/trace_frame.h"
#include "shaders/shaders.h"
#include "tests/render/adversarial_volumes.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

/// Looks at places along each ray: is the block there active, and is the place in a segment of the ray's list?
constexpr const char* kSegmentsKernel = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "picture.glsl"
#include "ray_segments.glsl"
#include "block_number.glsl"
layout(binding = 3) uniform usamplerBuffer gridLevel;
layout(binding = 9) uniform usamplerBuffer raySegments;
layout(std430, binding = 20) buffer Tally { uint seen[]; };  // active places, empty ones, active ones of no segment, empty ones of a segment
void main() {
  ivec2 pixel = lane_pixel();
  Ray ray = make_ray(pixel);
  uvec4 tally = uvec4(0u);
  bool inside = in_picture(pixel) && ray.begin < ray.end;
  for (int k = 0; k < 300; ++k) {
    float t = mix(ray.begin, ray.end, fract(0.618034 * float(k) + 0.1));
    bool matters = texelFetch(gridLevel, block_number(cell_at(ray, t) >> parameters.blocks.w)).r == 255u;
    bool listed = false, last = false;
    for (int n = 0; n < parameters.structure.x; ++n) {
      vec2 s = uintBitsToFloat(texelFetch(raySegments, segment_place(ray, n)).xy);
      listed = listed || (!last && t >= s.x && t < s.y);
      last = last || s.y == NEVER;
    }
    tally += inside ? uvec4(matters, !matters, matters && !listed, !matters && listed) : uvec4(0u);
  }
  for (int c = 0; c < 4; ++c) seen[4 * ray.number + c] = tally[c];
})";

constexpr int kSize = 40;
constexpr std::size_t kRays = kSize * kSize;  // whole tiles

struct Lists {
  std::vector<glm::vec2> segments;   ///< as the device has them
  std::vector<glm::uvec4> tallies;   ///< of each ray
  std::array<std::uint32_t, 3> counts{};

  glm::vec2 at(std::size_t ray, int capacity, int n) const { return segments[(ray / 64 * std::size_t(capacity) + std::size_t(n)) * 64 + ray % 64]; }
};

class RaySegments : public DeviceTest {
 protected:
  static Lists lists_of(const AdversarialVolume& v, const SkipConfig& config) {
    gpu::Device& device = test_kernels()->device();
    const auto spline = make_spline("bcc7");
    const Coefficients<float> coefficients = spline->coefficients_float(v.volume, Spline::Prefilter::automatic);
    const std::vector<double> isovalues{v.isovalue};
    VolumeBounds bounds(cell_bounds(*spline, coefficients));
    DeviceSkipping segments(device), grid(device);
    RenderStats stats;
    segments.prepare(config, &bounds, ranges_of(isovalues), glm::dvec3(0.0), stats);
    grid.prepare(labelled_skip("grid", {.block = config.block, .cell_test = false}), &bounds, ranges_of(isovalues), glm::dvec3(0.0), stats);

    TraceParameters parameters = trace_parameters(request_for(v.volume, v.isovalue, kSize).scene, coefficients);
    segments.set_parameters(parameters);
    KernelVariant variant;
    set_structure(variant, *make_structure(config));
    const gpu::Pipeline list = gpu::create_pipeline(device, gpu::compile(device, kernel_files(variant), kernel_source(variant, Pass::segments)));
    const auto files = [&](std::string_view name) { return name == "look.comp" ? std::string_view(kSegmentsKernel) : shader_file(name); };
    const gpu::Pipeline look = gpu::create_pipeline(device, gpu::compile(device, files, {"look.comp", {{"RAY_SEGMENTS", "1"}}}));

    const std::size_t texels = kRays * std::size_t(config.max_segments);
    // What was there before must not count.
    const std::vector<glm::vec2> old(texels, glm::vec2(-100.0f, 100.0f));
    const gpu::Buffer lists = gpu::create_filled(device, std::as_bytes(std::span(old)), gpu::BufferUse::texel, "segments", VK_FORMAT_R32G32_UINT);
    const gpu::Buffer uniforms = gpu::create_filled(device, std::as_bytes(std::span(&parameters, 1)), gpu::BufferUse::uniform, "parameters");
    const gpu::Buffer counts = gpu::create_buffer(device, 12, gpu::BufferUse::storage, "counts");
    const gpu::Buffer tally = gpu::create_buffer(device, kRays * 16, gpu::BufferUse::storage, "tally");
    gpu::Resources of_list = segments.resources(), of_look = grid.resources();
    of_list.insert(of_list.end(), {{"uniforms", uniforms}, {"RaySegments", lists}, {"SegmentCounts", counts}});
    of_look.insert(of_look.end(), {{"uniforms", uniforms}, {"raySegments", lists}, {"Tally", tally}});
    gpu::dispatch(device, list, of_list, {}, kSize / 8, kSize / 8);
    gpu::dispatch(device, look, of_look, {}, kSize / 8, kSize / 8);

    Lists made{.segments = std::vector<glm::vec2>(texels), .tallies = std::vector<glm::uvec4>(kRays)};
    gpu::download(device, lists, std::as_writable_bytes(std::span(made.segments)));
    gpu::download(device, tally, std::as_writable_bytes(std::span(made.tallies)));
    gpu::download(device, counts, std::as_writable_bytes(std::span(made.counts)));
    return made;
  }
};

/// Segments of a list; expects that they ascend and do not touch.
int expect_list(const Lists& lists, std::size_t ray, int capacity) {
  int count = 0;
  float before = -std::numeric_limits<float>::infinity();
  for (int n = 0; n < capacity; ++n) {
    const glm::vec2 s = lists.at(ray, capacity, n);
    EXPECT_GT(s.x, before) << "ray " << ray << ", segment " << n;
    if (std::isinf(s.x)) {
      EXPECT_TRUE(std::isinf(s.y));
      return count;
    }
    EXPECT_GT(s.y, s.x) << "ray " << ray << ", segment " << n;
    ++count;
    if (std::isinf(s.y)) return count;
    before = s.y;
  }
  ADD_FAILURE() << "ray " << ray << ": the list has no end";
  return count;
}

TEST_F(RaySegments, AscendDoNotTouchAndHoldTheActiveBlocksAndNothingElse) {
  std::uint64_t active = 0, empty = 0;
  std::uint32_t most = 0;
  for (const AdversarialVolume& v : adversarial_volumes())
    for (const int block : {1, 4}) {
      SCOPED_TRACE(v.name + ", block " + std::to_string(block));
      const int capacity = 64;
      const Lists lists = lists_of(v, {.structure = "segments", .block = block, .cell_test = false, .max_segments = capacity});
      std::uint32_t listed = 0;
      for (std::size_t ray = 0; ray < kRays; ++ray) {
        const int count = expect_list(lists, ray, capacity);
        listed += std::uint32_t(count);
        most = std::max(most, std::uint32_t(count));
        active += lists.tallies[ray].x;
        empty += lists.tallies[ray].y;
        ASSERT_EQ(lists.tallies[ray].z, 0u) << "ray " << ray;
        ASSERT_EQ(lists.tallies[ray].w, 0u) << "ray " << ray;
      }
      EXPECT_EQ(lists.counts[1], listed);
      EXPECT_EQ(lists.counts[2], 0u);
    }
  EXPECT_GT(active, 10000u);
  EXPECT_GT(empty, 10000u);
  EXPECT_GT(most, 3u);
}

TEST_F(RaySegments, OfAFullListHoldTheRestOfTheRay) {
  for (const int capacity : {1, 2}) {
    SCOPED_TRACE(capacity);
    const AdversarialVolume v{"noise, now and then above", random_volume({12, 10, 9}, 5), 0.9};
    const Lists lists = lists_of(v, {.structure = "segments", .block = 1, .cell_test = false, .max_segments = capacity});
    std::uint32_t full = 0;
    std::uint64_t beyond = 0;
    for (std::size_t ray = 0; ray < kRays; ++ray) {
      full += expect_list(lists, ray, capacity) == capacity;
      ASSERT_EQ(lists.tallies[ray].z, 0u) << "ray " << ray;
      beyond += lists.tallies[ray].w;
    }
    EXPECT_LE(lists.counts[2], full);
    EXPECT_GT(lists.counts[2], 50u);
    EXPECT_GT(beyond, 1000u);
  }
}

/// Pictures with so short lists that most are full, and in bands.
TEST_F(RaySegments, TooShortForTheirRaysChangeNoPicture) {
  const Volume volume = random_volume({12, 10, 9}, 5);
  for (const Precision precision : {Precision::float32, Precision::float64})
    for (const bool tf : {false, true}) {
      SCOPED_TRACE(std::string(precision_name(precision)) + (tf ? ", a volume" : ", surfaces"));
      Renderer::Request request = request_for(volume, 0.9, 52);
      if (tf) {
        request.scene.isosurfaces.clear();
        request.scene.volume.emplace();
        request.scene.volume->function = {.colors = {{0.0, {1.0, 0.5, 0.2}}}, .opacities = {{0.93, 0.0}, {0.96, 0.5}, {0.99, 0.0}}};
      } else {
        request.scene.isosurfaces.front().opacity = 0.5;
      }
      Renderer::Config config;
      config.precision = precision;
      DeviceRenderer renderer(test_kernels(), volume, config), banded(test_kernels(), volume, config, {.texel_elements = 0, .frame_bytes = 56 * 16 * 16});
      RenderStats stats;
      request.skip.structure = "none";
      const Frame truth = renderer.render(request, stats);
      EXPECT_EQ(stats.segments.capacity, 0);
      std::uint64_t listed = 0;
      for (const int capacity : {1, 2, 64}) {
        SCOPED_TRACE(capacity);
        request.skip = {.structure = "segments", .block = 1, .cell_test = capacity == 2, .max_segments = capacity};
        expect_same_picture(renderer.render(request, stats), truth);
        EXPECT_EQ(stats.segments.capacity, capacity);
        ASSERT_EQ(stats.segments.ms.size(), 1u);
        EXPECT_GT(stats.segments.ms[0], 0.0);
        EXPECT_LT(stats.segments.ms[0], stats.trace_ms[0]);
        EXPECT_EQ(stats.segments.full > 0, capacity < 64);
        EXPECT_GT(stats.segments.listed, listed);
        const std::uint64_t all = listed = stats.segments.listed;
        expect_same_picture(banded.render(request, stats), truth);
        EXPECT_EQ(stats.segments.listed, all) << "of all bands together";
      }
    }
}

}  // namespace
}  // namespace quincunx

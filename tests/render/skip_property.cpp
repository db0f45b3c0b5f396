#include "tests/render/skip_property.h"

#include <map>

#include "render/trace_frame.h"
#include "shaders/shaders.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

constexpr const char* kSkipKernel = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "coefficients.glsl"
#include "spline.glsl"
#include "isosurfaces.glsl"
#include "walk.glsl"
#ifdef RAY_SEGMENTS
#include "segments.glsl"
#endif
layout(local_size_x = 64) in;
layout(std430, binding = 20) buffer Tally { uint seen[]; };  // rays, stretches, points, violations of a lane
layout(push_constant) uniform Push { vec4 eye; uint seed, listing; };  // lattice coordinates; .w: whether all rays come from it; whether to list segments alone

uint state;
float uniform01() {  // PCG: M. O'Neill, 2014
  state = state * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float(((word >> 22u) ^ word) >> 8) / 16777216.0;
}
vec3 uniform_point() { return vec3(uniform01(), uniform01(), uniform01()); }
vec3 uniform_direction() {
  vec3 p = vec3(1.0);
  for (int i = 0; i < 8 && (dot(p, p) > 1.0 || dot(p, p) < 1e-4); ++i) p = 2.0 * uniform_point() - 1.0;
  return normalize(p);
}

// Through a point of the domain; one ray in four along an axis or a diagonal, one in four through a lattice point or along a plane.
Ray random_ray() {
  vec3 size = vec3(parameters.cells.xyz);
  vec3 through = uniform_point() * size;
  vec3 d = uniform_direction();
  float kind = uniform01();
  if (kind < 0.25) d = normalize(round(1.5 * d) + vec3(0.0, 0.0, length(round(1.5 * d)) < 0.5 ? 1.0 : 0.0));
  if (kind > 0.75) through = round(through);
  if (kind > 0.875) through.x += uniform01() - 0.5;
  float back = uniform01() < 0.2 ? 0.0 : 2.0 * length(size) * (0.5 + uniform01());  // one in five starts inside
  through -= 0.5 * size;
  if (eye.w > 0.0) {
    vec3 from = eye.xyz - 0.5 * size;
    return clipped_ray(from, normalize(through - from + vec3(1e-6, 2e-6, 3e-6)), 0.0);
  }
  return clipped_ray(through, d, -back);
}

bool above(Ray ray, float t) { return spline_value_at(ray.o + clamp(t, ray.begin, ray.end) * ray.d, ray.centre, scaled_isovalue(0)) >= 0.0; }

void main() {
  uint lane = gl_GlobalInvocationID.x;
  state = seed * 2654435761u + lane * 805459861u;
  uniform01();
  Ray ray = random_ray();
  bool alive = ray.begin < ray.end;
#ifdef RAY_SEGMENTS
  ray.number = int(lane);
  if (listing != 0u) {
    list_segments(ray, true);
    return;
  }
#endif
  uint stretches = 0u, violations = 0u;
  Walk walk = begin_walk(ray, ray.begin, ray.begin);
  bool seeking = alive;
  do {
    float start = walk.t;
    bool found = find_cell(ray, walk, seeking, 0u);
    float end = found ? walk.t : ray.end;
    bool skipped = seeking && end > start;
    bool side = above(ray, start);
    float a = uniform01(), b = uniform01();
    uint wrong = (above(ray, mix(start, end, a)) != side ? 1u : 0u) + (above(ray, mix(start, end, b)) != side ? 1u : 0u) + (above(ray, end) != side ? 1u : 0u);
    stretches += skipped ? 1u : 0u;
    violations += skipped ? wrong : 0u;
    seeking = seeking && found;
#ifdef CELL_TEST
    float leave = exit_time(ray, walk.cell, 1);
#else
    float leave = walk.until;
#endif
    leave = min(leave, ray.end);
    ivec3 next = cell_at(ray, leave);
    walk.t = seeking ? leave : walk.t;
    walk.cell = seeking ? next : walk.cell;
    seeking = seeking && walk.t < ray.end;
  } while (subgroupAny(seeking));
  seen[3u * lane] += alive ? 1u : 0u;
  seen[3u * lane + 1u] += stretches;
  seen[3u * lane + 2u] += violations;
})";

struct Push {
  glm::vec4 eye;
  std::uint32_t seed, listing;
};

/// Inside the domain, near it or far from it, in lattice coordinates.
glm::dvec3 random_eye(const glm::dvec3& size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  const double reach = seed % 3 == 0 ? 0.8 : seed % 3 == 1 ? 2.5 : 8.0;
  const glm::dvec3 off(uniform(random), uniform(random), uniform(random));
  return 0.5 * size + reach * off * glm::length(size);
}

CellBounds shrunken(CellBounds cells, double part) {
  for (std::size_t n = 0; n < cells.min.size(); ++n) {
    const int by = int(std::ceil(part * (cells.max[n] - cells.min[n])));
    cells.min[n] = std::uint16_t(std::min(65535, cells.min[n] + by));
    cells.max[n] = std::uint16_t(std::max(0, cells.max[n] - by));
  }
  return cells;
}

const gpu::Pipeline& property_pipeline(const SkipConfig& config) {
  static std::map<KernelVariant, gpu::Pipeline> made;
  KernelVariant variant;
  const auto structure = make_structure(config);
  set_structure(variant, *structure);
  variant.cell_test = config.cell_test;
  variant.intersect = Intersect::march;  // evaluates points
  const auto found = made.find(variant);
  if (found != made.end()) return found->second;
  gpu::KernelSource source = kernel_source(variant, Pass::trace);
  source.file = "property.comp";
  const auto files = [rest = kernel_files(variant)](std::string_view name) {
    return name == "property.comp" ? std::string_view(kSkipKernel) : rest(name);
  };
  gpu::Device& device = test_kernels()->device();
  return made[variant] = gpu::create_pipeline(device, gpu::compile(device, files, source));
}

}  // namespace

SkippedSpace look_into_skipped_space(const AdversarialVolume& v, const SkipConfig& config, std::uint32_t rays, std::uint32_t seed, double shrink) {
  gpu::Device& device = test_kernels()->device();
  const auto spline = make_spline("bcc7");
  const Coefficients<float> coefficients = spline->coefficients_float(v.volume, Spline::Prefilter::automatic);
  const Renderer::Request request = request_for(v.volume, v.isovalue);
  const CellBounds cells = shrunken(cell_bounds(*spline, coefficients), shrink);
  const std::vector<double> isovalues{v.isovalue};

  DeviceSkipping skipping(device);
  RenderStats stats;
  const glm::dvec3 eye = random_eye(glm::dvec3(cells.cells), seed);
  VolumeBounds bounds(cells);
  skipping.prepare(config, &bounds, ranges_of(isovalues), eye, stats);
  TraceParameters parameters = trace_parameters(request.scene, coefficients);
  skipping.set_parameters(parameters);

  const gpu::Pipeline& pipeline = property_pipeline(config);
  const auto filled = [&](std::span<const std::byte> bytes, gpu::BufferUse use, const char* name, VkFormat format = VK_FORMAT_UNDEFINED) {
    return gpu::create_filled(device, bytes, use, name, format);
  };
  const std::vector<float> isosurface{float(v.isovalue), 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f, 0.0f};
  std::vector<std::uint32_t> tally(3 * std::size_t(rays));
  const gpu::Buffer tallies = filled(std::as_bytes(std::span(tally)), gpu::BufferUse::storage, "tally");
  gpu::Resources resources = skipping.resources();
  resources.emplace_back("uniforms", filled(std::as_bytes(std::span(&parameters, 1)), gpu::BufferUse::uniform, "parameters"));
  resources.emplace_back("Isosurfaces", filled(std::as_bytes(std::span(isosurface)), gpu::BufferUse::storage, "isosurfaces"));
  resources.emplace_back("coefficients0", filled(std::as_bytes(std::span(coefficients.data)), gpu::BufferUse::texel, "coefficients", VK_FORMAT_R32_SFLOAT));
  resources.emplace_back("Tally", tallies);
  const bool from_eye = config.structure == "hybrid" || (config.structure == "kdtree" && config.kd == KdDepth::shallow);  // sorted for one eye
  const auto run = [&](bool listing) {
    const Push push{glm::vec4(glm::vec3(eye), from_eye ? 1.0f : 0.0f), seed, listing};
    gpu::dispatch(device, pipeline, resources, std::as_bytes(std::span(&push, 1)).first(pipeline.reflection.push_constant_bytes), rays / 64);
  };
  if (const auto pass = skipping.segment_pass()) {
    const std::uint64_t bytes = std::uint64_t(rays) * std::uint64_t(pass->capacity) * 8;
    const gpu::Buffer segments = gpu::create_buffer(device, bytes, gpu::BufferUse::texel, "ray segments", VK_FORMAT_R32G32_UINT);
    resources.insert(resources.end(), {{"RaySegments", segments}, {"raySegments", segments},
                                       {"SegmentCounts", gpu::create_buffer(device, 12, gpu::BufferUse::storage, "segment counts")}});
    run(true);
  }
  run(false);
  gpu::download(device, tallies, std::as_writable_bytes(std::span(tally)));

  SkippedSpace seen;
  for (std::size_t n = 0; n < tally.size(); n += 3) seen += {tally[n], tally[n + 1], 4 * std::uint64_t(tally[n + 1]), tally[n + 2]};
  return seen;
}

}  // namespace quincunx

#include "render/device_probe.h"

#include <array>
#include <cassert>
#include <string>
#include <string_view>

#include "shaders/shaders.h"
#include "shaders/shared/trace_parameters.h"

namespace quincunx {
namespace {

constexpr std::uint32_t kGroup = 64;

std::uint32_t groups_of(std::size_t count) { return std::uint32_t((count + kGroup - 1) / kGroup); }

template <class T>
gpu::Buffer filled(gpu::Device& device, std::span<const T> values, gpu::BufferUse use, const char* label, VkFormat format = VK_FORMAT_UNDEFINED) {
  return gpu::create_filled(device, std::as_bytes(values), use, label, format);
}

}  // namespace

std::vector<Jet> probe_spline(gpu::Device& device, const Spline& spline, const Coefficients<float>& c, double reference, std::span<glm::dvec3> points) {
  const glm::i64vec3 cells = cell_count(c.lattice, c.extents);
  const glm::dvec3 centre = glm::dvec3(cells) * 0.5;
  TraceParameters p{};
  p.cells = ivec4(glm::ivec3(cells), 0);
  p.strides = ivec4(int(c.stride_y()), int(c.stride_z()), int(c.stride_coset()), int(c.number(0, glm::i64vec3(0))));
  p.march.x = float(reference);
  std::vector<glm::vec4> asked;
  for (glm::dvec3& u : points) {
    asked.emplace_back(glm::vec3(u - centre), 0.0f);
    u = centre + glm::dvec3(asked.back());
  }

  const auto files = [&](std::string_view name) { return shader_file(name == "spline.glsl" ? spline.shader() : name); };
  const gpu::KernelSource source{"probe.comp", {{"VOLUME", "1"}, {"COEFFICIENT_BUFFERS", "1"}, {"COEFFICIENT_SHIFT", "0"}}};
  const gpu::Pipeline pipeline = gpu::create_pipeline(device, gpu::compile(device, files, source));
  const gpu::Buffer jets = gpu::create_buffer(device, asked.size() * sizeof(glm::vec4), gpu::BufferUse::storage, "jets");
  gpu::dispatch(device, pipeline,
                {{"uniforms", filled(device, std::span<const TraceParameters>(&p, 1), gpu::BufferUse::uniform, "parameters")},
                 {"coefficients0", filled(device, std::span<const float>(c.data), gpu::BufferUse::texel, "coefficients", VK_FORMAT_R32_SFLOAT)},
                 {"Points", filled(device, std::span<const glm::vec4>(asked), gpu::BufferUse::storage, "points")},
                 {"Jets", jets}},
                {}, groups_of(asked.size()));
  std::vector<glm::vec4> answers(asked.size());
  gpu::download(device, jets, std::as_writable_bytes(std::span(answers)));
  std::vector<Jet> result;
  for (const glm::vec4& a : answers) result.push_back({a.w, glm::dvec3(a)});
  return result;
}

std::vector<float> probe_roots(gpu::Device& device, int degree, std::span<const float> bernstein) {
  const std::size_t each = std::size_t(degree) + 1;
  assert(bernstein.size() % each == 0);
  const gpu::KernelSource source{"roots.comp", {{"SPLINE_DEGREE", std::to_string(degree)}}};
  const gpu::Pipeline pipeline = gpu::create_pipeline(device, gpu::compile(device, [](std::string_view name) { return shader_file(name); }, source));
  std::vector<float> roots(bernstein.size() / each);
  const gpu::Buffer out = gpu::create_buffer(device, roots.size() * sizeof(float), gpu::BufferUse::storage, "roots");
  gpu::dispatch(device, pipeline, {{"Polynomials", filled(device, bernstein, gpu::BufferUse::storage, "polynomials")}, {"Roots", out}}, {},
                groups_of(roots.size()));
  gpu::download(device, out, std::as_writable_bytes(std::span(roots)));
  return roots;
}

}  // namespace quincunx

// The kernels' root finder on quartics whose roots are known.
#include <gtest/gtest.h>

#include <array>

#include "render/roots.h"
#include "shaders/shaders.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using DeviceBernsteinTest = DeviceTest;
using Quartic = std::array<float, 5>;  // Bernstein coefficients on [0,1], the first one positive

constexpr const char* kKernel = R"(#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Quartics { float b[]; };
layout(std430, binding = 1) writeonly buffer Roots { float root[]; };
#include "bernstein.glsl"
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (5u * i + 4u < b.length()) root[i] = first_root(b[5u * i], b[5u * i + 1u], b[5u * i + 2u], b[5u * i + 3u], b[5u * i + 4u]);
})";

std::vector<float> device_roots(const std::vector<Quartic>& quartics) {
  gpu::Device& device = test_kernels()->device();
  const auto files = [](std::string_view name) { return name == "test.comp" ? std::string_view(kKernel) : shader_file(name); };
  const gpu::Pipeline pipeline = gpu::create_pipeline(device, gpu::compile(device, files, {"test.comp", {}}));
  const gpu::Buffer in = gpu::create_buffer(device, quartics.size() * sizeof(Quartic), gpu::BufferUse::storage, "quartics");
  const gpu::Buffer out = gpu::create_buffer(device, quartics.size() * sizeof(float), gpu::BufferUse::storage, "roots");
  gpu::upload(device, in, std::as_bytes(std::span(quartics)));
  gpu::dispatch(device, pipeline, {{"Quartics", in}, {"Roots", out}}, {}, std::uint32_t((quartics.size() + 63) / 64));
  std::vector<float> roots(quartics.size());
  gpu::download(device, out, std::as_writable_bytes(std::span(roots)));
  return roots;
}

double value_at(const Quartic& b, double x) {
  std::array<double, 5> c{b[0], b[1], b[2], b[3], b[4]};
  for (int n = 4; n > 0; --n)
    for (int i = 0; i < n; ++i) c[i] += x * (c[i + 1] - c[i]);
  return c[0];
}

/// What is wrong with `root`, or nothing. A value within 1e-6 of the largest coefficient may count as either side, and at
/// a root 2e-5 may be left to the Newton step that ends every hit.
std::string complaint(const Quartic& b, float root) {
  double largest = 0.0;
  for (const float c : b) largest = std::max(largest, std::abs(double(c)));
  const double doubt = 1e-6 * largest;
  const double end = root >= 0.0f ? std::min(1.0, double(root)) : 1.0;
  // Nothing before the root (or anywhere, where none was found) may be on the far side beyond doubt.
  for (int k = 0; k <= 2000; ++k)
    if (const double x = end * k / 2000.0; value_at(b, x) < -doubt && x < end - 1e-5) return "passed a root before " + std::to_string(x);
  if (root >= 0.0f && std::abs(value_at(b, end)) > 2e-5 * largest) return "stopped where the value is " + std::to_string(value_at(b, end));
  return "";
}

void expect_right(const std::vector<Quartic>& quartics) {
  const std::vector<float> roots = device_roots(quartics);
  int found = 0;
  for (std::size_t i = 0; i < quartics.size(); ++i) {
    found += roots[i] >= 0.0f;
    const Quartic& b = quartics[i];
    ASSERT_EQ(complaint(b, roots[i]), "") << b[0] << " " << b[1] << " " << b[2] << " " << b[3] << " " << b[4] << " root " << roots[i];
  }
  EXPECT_GT(found, int(quartics.size()) / 8);
}

TEST_F(DeviceBernsteinTest, FindsTheFirstRootOfRandomQuartics) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<Quartic> quartics(6000);
  for (Quartic& b : quartics) {
    for (float& c : b) c = normal(random);
    b[0] = std::abs(b[0]) + 1e-3f;
  }
  expect_right(quartics);
}

TEST_F(DeviceBernsteinTest, FindsADipBelowZeroHoweverShallow) {
  // (x - r)^2 - e, between steep walls or gentle ones, the far end positive: two roots close together.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform;
  std::vector<Quartic> quartics(6000);
  for (Quartic& b : quartics) {
    const double r = 0.1 + 0.8 * uniform(random), e = std::pow(10.0, -6.0 * uniform(random)) * 0.01, tilt = 0.9 * uniform(random);
    // Quadratic Bernstein coefficients, raised to degree 4 and tilted by the positive factor (1 - tilt x)^2.
    const double q[3] = {r * r - e, r * r - r - e, (1 - r) * (1 - r) - e}, w[3] = {1.0, 1.0 - tilt, (1.0 - tilt) * (1.0 - tilt)};
    b = {float(q[0] * w[0]), float((q[0] * w[1] + q[1] * w[0]) / 2), float((q[0] * w[2] + 4 * q[1] * w[1] + q[2] * w[0]) / 6),
         float((q[1] * w[2] + q[2] * w[1]) / 2), float(q[2] * w[2])};
    for (float& c : b) c *= 1000.0f;
    if (b[0] <= 0.0f) b[0] = 1e-3f;
  }
  expect_right(quartics);
}

TEST_F(DeviceBernsteinTest, FindsTheRootsThatAnImageLost) {
  expect_right({{2100.33f, 70.3226f, -692.753f, -220.221f, 1282.43f}, {0.873265f, -12.2934f, -33.2884f, -26.9711f, 48.1246f}});
}

}  // namespace
}  // namespace quincunx

// What fits a device is asked before anything is read.
#include "render/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu/gpu.h"
#include "lattice/error.h"
#include "lattice/memory.h"
#include "render/coefficient_texels.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

Volume header(LatticeKind lattice, const Extents& extents, Volume::Samples samples = std::vector<std::uint8_t>()) {
  return {.lattice = lattice, .extents = extents, .world = {}, .samples = std::move(samples), .notes = {}};
}

TEST(Renderer, TakesAVolumeWholeThatFits) {
  EXPECT_EQ(why_not_whole("", header(LatticeKind::bcc, {128, 128, 60}), {}), "");
  EXPECT_EQ(why_not_whole("", header(LatticeKind::cartesian, {512, 512, 361}), {}), "");
}

TEST(Renderer, SaysWhyAVolumeDoesNotFit) {
  // 2^31 - 1 is a number that kernels still count to, but 1291^3 is more.
  EXPECT_THAT(why_not_whole("", header(LatticeKind::cartesian, {1291, 1291, 1291}), {}), HasSubstr("2151685171 coefficients are more than the "));
  EXPECT_THAT(why_not_whole("", header(LatticeKind::bcc, {1100, 1100, 1100}), {}), HasSubstr("coefficients are more than"));
  // One whose numbers can be counted, but not held.
  const gpu::DeviceInfo device = gpu::list_devices().at(gpu::choose_device(gpu::list_devices(), ""));
  const std::uint64_t most = most_coefficients(device.max_texel_buffer_elements);
  const std::int64_t planes = std::int64_t(most / (2000 * 2000));
  const std::string why = why_not_whole("", header(LatticeKind::cartesian, {2000, 2000, planes}, std::vector<float>()), {});
  const std::uint64_t bytes = std::uint64_t(planes) * 2000 * 2000 * (device.type == "CPU" ? 16 : 12);  // samples, coefficients, bounds
  EXPECT_EQ(why.empty(), bytes <= memory_bytes()) << why;
}

TEST(Renderer, OfTheCpuHasNoPool) { EXPECT_EQ(why_not_whole("cpu", header(LatticeKind::cartesian, {5000, 5000, 5000}), {}), ""); }

TEST(Renderer, NamesAWrongDeviceOrSplineBeforeAnythingIsRead) {
  EXPECT_THROW(why_not_whole("no such device", header(LatticeKind::bcc, {8, 8, 8}), {}), gpu::DeviceError);
  Renderer::Config config;
  config.spline = "tricubic";
  EXPECT_THROW(why_not_whole("", header(LatticeKind::bcc, {8, 8, 8}), config), InputError);
}

TEST(CoefficientTexels, TakeAsManyNumbersAsTheySay) {
  for (const std::uint64_t elements : {std::uint64_t(1) << 16, std::uint64_t(100000), std::uint64_t(1) << 27, std::uint64_t(1) << 31}) {
    const std::uint64_t most = most_coefficients(elements);
    EXPECT_NO_THROW(texel_layout(most, elements, "a device"));
    EXPECT_ANY_THROW(texel_layout(most + 1, elements, "a device"));
  }
}

}  // namespace
}  // namespace quincunx

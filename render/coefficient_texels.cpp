#include "render/coefficient_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr std::uint64_t kMostBuffers = 8;  // bindings of coefficients.glsl
constexpr std::uint64_t kMostNumbers = std::numeric_limits<std::int32_t>::max();  // that kernels count

/// Elements of each of several buffers: a power of two.
std::uint64_t elements_of_each(std::uint64_t texel_elements) { return std::bit_floor(texel_elements); }

}  // namespace

TexelLayout texel_layout(std::uint64_t numbers, std::uint64_t texel_elements, const std::string& device) {
  if (numbers > kMostNumbers)
    throw InputError(fmt::format("volume: {} coefficients with their border; expected at most 2^31 - 1, or a pool of bricks (--pool)", numbers));
  if (numbers <= texel_elements) return {};
  const int shift = std::countr_zero(elements_of_each(texel_elements));
  const std::uint64_t buffers = (numbers + (std::uint64_t(1) << shift) - 1) >> shift;
  if (buffers > kMostBuffers)
    throw gpu::DeviceError(fmt::format("{}: {} coefficients need {} texel buffers of 2^{} elements; expected at most {}, or a pool of bricks (--pool)",
                                       device, numbers, buffers, shift, kMostBuffers));
  return {int(buffers), shift};
}

std::uint64_t most_coefficients(std::uint64_t texel_elements) { return std::min(kMostNumbers, kMostBuffers * elements_of_each(texel_elements)); }

void check_storage(Storage storage, Precision precision) {
  if (storage != Storage::float32 && precision == Precision::float64)
    throw InputError(fmt::format("--storage: found {} with --precision double, expected float32: coefficients are then 64-bit floats", storage_name(storage)));
}

VkFormat CoefficientFormat::texels() const {
  if (precision == Precision::float64) return VK_FORMAT_R32G32_UINT;
  switch (storage) {
    case Storage::float32: return VK_FORMAT_R32_SFLOAT;
    case Storage::float16: return VK_FORMAT_R16_SFLOAT;
    case Storage::unorm16: return VK_FORMAT_R16_UNORM;
    case Storage::unorm8: break;
  }
  return VK_FORMAT_R8_UNORM;
}

CoefficientTexels::CoefficientTexels(gpu::Device& device, std::uint64_t numbers, std::uint64_t texel_elements, const std::string& label,
                                     const CoefficientFormat& format)
    : layout_(texel_layout(numbers, texel_elements, gpu::info(device).name)), format_(format) {
  // Kernels read every buffer at every number: all are of one length.
  each_ = (layout_.buffers == 1 ? numbers : std::uint64_t(1) << layout_.shift) * format.bytes();
  for (int i = 0; i < layout_.buffers; ++i)
    buffers_.push_back(gpu::create_buffer(device, each_, gpu::BufferUse::texel, label, format.texels()));
}

void CoefficientTexels::upload(gpu::Device& device, std::int64_t first, std::span<const std::byte> numbers) const {
  assert(numbers.size() % format_.bytes() == 0);
  std::uint64_t offset = std::uint64_t(first) * format_.bytes();
  while (!numbers.empty()) {
    const std::uint64_t at = offset % each_;
    const std::size_t count = std::size_t(std::min<std::uint64_t>(numbers.size(), each_ - at));
    gpu::upload(device, buffers_[std::size_t(offset / each_)], numbers.first(count), at);
    numbers = numbers.subspan(count);
    offset += count;
  }
}

gpu::Resources CoefficientTexels::resources() const {
  gpu::Resources all;
  for (std::size_t i = 0; i < buffers_.size(); ++i) all.emplace_back("coefficients" + std::to_string(i), buffers_[i]);
  return all;
}

std::uint64_t CoefficientTexels::bytes() const {
  std::uint64_t sum = 0;
  for (const gpu::Buffer& buffer : buffers_) sum += buffer.bytes;
  return sum;
}

}  // namespace quincunx

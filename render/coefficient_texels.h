// Coefficients on the device: one texel buffer, or several where the device limits their elements (shaders/coefficients.glsl).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/gpu.h"
#include "render/precision.h"

namespace quincunx {

/// How so many numbers lie in texel buffers: one, or several of 2^shift elements.
struct TexelLayout {
  int buffers = 1, shift = 0;
};
/// Throws InputError where there are more than 2^31 - 1, DeviceError, naming `device`, where they do not fit the buffers that kernels read.
TexelLayout texel_layout(std::uint64_t numbers, std::uint64_t texel_elements, const std::string& device);

/// The most numbers that texel_layout takes.
std::uint64_t most_coefficients(std::uint64_t texel_elements);

class CoefficientTexels {
 public:
  CoefficientTexels() = default;
  /// Room for so many floats of `precision`, each an element. Throws as texel_layout, and DeviceError where memory is short.
  CoefficientTexels(gpu::Device& device, std::uint64_t numbers, std::uint64_t texel_elements, const std::string& label,
                    Precision precision = Precision::float32);

  const TexelLayout& layout() const { return layout_; }
  /// From number `first` on; of the precision that there is room for.
  void upload(gpu::Device& device, std::int64_t first, std::span<const float> numbers) const;
  void upload(gpu::Device& device, std::int64_t first, std::span<const double> numbers) const;
  /// "coefficients0", ...
  gpu::Resources resources() const;
  std::uint64_t bytes() const;

 private:
  void upload_bytes(gpu::Device& device, std::uint64_t offset, std::span<const std::byte> bytes) const;

  TexelLayout layout_;
  Precision precision_ = Precision::float32;
  std::uint64_t each_ = 0;  ///< bytes a buffer
  std::vector<gpu::Buffer> buffers_;
};

}  // namespace quincunx

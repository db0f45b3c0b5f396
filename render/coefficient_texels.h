// Coefficients on the device: one texel buffer, or several where the device limits their elements (shaders/coefficients.glsl).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/gpu.h"
#include "render/precision.h"
#include "spline/storage.h"

namespace quincunx {

/// How so many numbers lie in texel buffers: one, or several of 2^shift elements.
struct TexelLayout {
  int buffers = 1, shift = 0;
};
/// Throws InputError where there are more than 2^31 - 1, DeviceError, naming `device`, where they do not fit the buffers that kernels read.
TexelLayout texel_layout(std::uint64_t numbers, std::uint64_t texel_elements, const std::string& device);

/// The most numbers that texel_layout takes.
std::uint64_t most_coefficients(std::uint64_t texel_elements);

/// What an element is: a double where kernels compute in doubles, else a number of `storage`.
struct CoefficientFormat {
  Precision precision = Precision::float32;
  Storage storage = Storage::float32;  ///< float32 where `precision` is float64

  std::uint64_t bytes() const { return precision == Precision::float64 ? sizeof(double) : storage_bytes(storage); }
  VkFormat texels() const;
  bool operator==(const CoefficientFormat&) const = default;
  /// "float64", or as --storage names it.
  const char* name() const { return precision == Precision::float64 ? "float64" : storage_name(storage); }
};

/// Throws InputError (--storage) for anything but float32 where kernels compute in doubles.
void check_storage(Storage storage, Precision precision);

class CoefficientTexels {
 public:
  CoefficientTexels() = default;
  /// Room for so many numbers of `format`, each an element. Throws as texel_layout, and DeviceError where memory is short or the device has no texel
  /// buffers of the format.
  CoefficientTexels(gpu::Device& device, std::uint64_t numbers, std::uint64_t texel_elements, const std::string& label,
                    const CoefficientFormat& format = {});

  const TexelLayout& layout() const { return layout_; }
  const CoefficientFormat& format() const { return format_; }
  /// From number `first` on: whole numbers of the format.
  void upload(gpu::Device& device, std::int64_t first, std::span<const std::byte> numbers) const;
  /// "coefficients0", ...
  gpu::Resources resources() const;
  std::uint64_t bytes() const;

 private:
  TexelLayout layout_;
  CoefficientFormat format_;
  std::uint64_t each_ = 0;  ///< bytes a buffer
  std::vector<gpu::Buffer> buffers_;
};

}  // namespace quincunx

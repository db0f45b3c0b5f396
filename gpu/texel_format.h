// Sizes of texel formats. Private to gpu/.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace quincunx::gpu {

/// Bytes of one texel; 0 for a format Vulkan does not have.
std::uint32_t texel_bytes(VkFormat format);
/// As Vulkan spells it, without VK_FORMAT_: "R32Sfloat".
std::string texel_format_name(VkFormat format);

}  // namespace quincunx::gpu

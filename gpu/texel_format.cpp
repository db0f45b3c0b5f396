#include "gpu/texel_format.h"

// The only sources that include the heavy C++ headers of Vulkan are this one and check.cpp.
#include <vulkan/vulkan_format_traits.hpp>

namespace quincunx::gpu {

// Of what is no format, the header asserts.
std::uint32_t texel_bytes(VkFormat format) { return format == VK_FORMAT_UNDEFINED ? 0 : vk::blockSize(static_cast<vk::Format>(format)); }

std::string texel_format_name(VkFormat format) { return vk::to_string(static_cast<vk::Format>(format)); }

}  // namespace quincunx::gpu

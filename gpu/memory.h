// Raw device memory behind buffers. Private to gpu/.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace quincunx::gpu {

class Device;

/// A VkBuffer with memory of its own.
struct Allocation {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;  ///< host memory is coherent; empty where the host cannot see it
  std::uint64_t bytes = 0;
};

enum class Placement { device, staging };  ///< staging: the host's memory, cached where possible

/// True where all device-local memory is the host's memory as well.
bool is_unified(VkPhysicalDevice physical);

/// Throws DeviceError naming `label`, the bytes and the device where a limit is passed or memory is short.
/// Contents are undefined.
Allocation allocate(Device& device, std::uint64_t bytes, VkBufferUsageFlags usage, Placement placement,
                    const std::string& label);
void release(Device& device, Allocation& allocation);

}  // namespace quincunx::gpu

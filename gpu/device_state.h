// The inside of a Device. Private to gpu/.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "gpu/device.h"
#include "gpu/instance.h"
#include "gpu/memory.h"

namespace quincunx::gpu {

class Device : public std::enable_shared_from_this<Device> {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device();  ///< saves the pipeline cache where it has grown

  DeviceInfo info;
  DeviceFeatures features;
  std::unique_ptr<Instance> instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceMemoryProperties memory{};
  std::uint64_t max_allocation = 0;  ///< bytes

  VkDevice handle = VK_NULL_HANDLE;
  QueueFamily family;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool command_pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkQueryPool timestamps = VK_NULL_HANDLE;  ///< two: before and after
  Allocation staging;                       ///< made when first needed
  std::mutex mutex;                         ///< of the queue, `commands`, `timestamps`, `staging` and descriptor sets

  std::string cache_folder;  ///< "": no cache
  std::string pipeline_cache_name;
  VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
  std::size_t pipeline_cache_bytes = 0;  ///< as loaded
};

/// Records with `record`, submits and waits. What was written is visible to all later work and to the host.
/// The caller holds device.mutex.
void run_commands(Device& device, const std::function<void(VkCommandBuffer)>& record);

}  // namespace quincunx::gpu

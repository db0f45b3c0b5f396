// The Vulkan instance, its validation messages, and what it says of its devices. Private to gpu/.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device_info.h"

namespace quincunx::gpu {

enum class Validation { off, on, gpu_assisted };

/// Owns the instance and, with validation, the messenger that fills `messages`.
struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  std::mutex mutex;                   ///< of `messages`: the layer may call from any thread
  std::vector<std::string> messages;  ///< warnings and errors, in order

  Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance();
};

/// Empty where no Vulkan driver is installed. Throws DeviceError where validation is asked for and not there.
std::unique_ptr<Instance> create_instance(Validation validation);

std::vector<VkPhysicalDevice> physical_devices(const Instance& instance);

/// The first queue family with compute and timestamps; one without graphics is preferred (it runs beside a display).
struct QueueFamily {
  std::uint32_t index = 0;
  std::uint32_t timestamp_bits = 0;  ///< 1..64
};
std::optional<QueueFamily> compute_family(VkPhysicalDevice physical);

DeviceInfo describe(VkPhysicalDevice physical, std::uint32_t index);

}  // namespace quincunx::gpu

// Compute pipelines.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "gpu/device.h"
#include "gpu/reflection.h"

namespace quincunx::gpu {

/// A compute pipeline; bindings come from reflection. Destroyed with the last copy of the handle.
struct Pipeline {
  std::shared_ptr<void> owner;
  VkPipeline handle = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;  ///< empty without bindings
  Reflection reflection;
};

/// Specialization constants are given by name, 32 bits each (a float's or bool's bits too); a name the kernel does not
/// have is an error (std::runtime_error), one not given keeps its default.
/// Throws DeviceError where the kernel needs a feature or a work group that the device does not have.
Pipeline create_pipeline(Device& device, std::span<const std::uint32_t> spirv,
                         std::span<const std::pair<std::string, std::uint32_t>> specialization = {});

}  // namespace quincunx::gpu

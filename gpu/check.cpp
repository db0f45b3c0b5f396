#include "gpu/check.h"

#include <fmt/format.h>
#include <vulkan/vulkan.hpp>

#include <stdexcept>

namespace quincunx::gpu {
namespace {

const char* explanation(VkResult result) {
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return " (the device stopped: a kernel ran too long or touched memory that is not its own)";
    case VK_ERROR_OUT_OF_HOST_MEMORY: return " (the computer's memory is short)";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY: return " (the device's memory is short)";
    case VK_ERROR_INCOMPATIBLE_DRIVER: return " (no Vulkan driver is installed)";
    default: return "";
  }
}

}  // namespace

void check(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  throw std::runtime_error(
      fmt::format("{} gave {}{}", call, vk::to_string(static_cast<vk::Result>(result)), explanation(result)));
}

}  // namespace quincunx::gpu

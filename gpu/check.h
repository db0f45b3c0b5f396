// The always-on check of Vulkan calls.
#pragma once

#include <vulkan/vulkan.h>

namespace quincunx::gpu {

/// Throws std::runtime_error with the text of the call and the name of the result where `result` is an error.
/// Positive results (VK_INCOMPLETE, VK_NOT_READY, ...) are errors too: nothing here expects them.
void check(VkResult result, const char* call);

}  // namespace quincunx::gpu

#define QUINCUNX_VK(call) ::quincunx::gpu::check((call), #call)

#include "gpu/memory.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "gpu/check.h"
#include "gpu/device_state.h"

namespace quincunx::gpu {
namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kMapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

// The first memory type among `allowed` that has all of `flags`.
std::optional<std::uint32_t> find_type(const Device& device, std::uint32_t allowed, VkMemoryPropertyFlags flags) {
  for (std::uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
    const bool has_all = (device.memory.memoryTypes[i].propertyFlags & flags) == flags;
    if ((allowed >> i & 1u) && has_all) return i;
  }
  return std::nullopt;
}

// Wishes in order; Vulkan promises that one of the last of each list exists for buffers.
std::uint32_t choose_type(const Device& device, std::uint32_t allowed, Placement placement) {
  const std::array<VkMemoryPropertyFlags, 3> staging = {kMapped | kCached, kMapped, kMapped};
  const std::array<VkMemoryPropertyFlags, 3> unified = {kLocal | kMapped | kCached, kLocal | kMapped, kLocal};
  const std::array<VkMemoryPropertyFlags, 3> apart = {kLocal, kLocal, 0};
  const auto& wishes = placement == Placement::staging ? staging : device.features.unified_memory ? unified : apart;
  for (VkMemoryPropertyFlags flags : wishes) {
    if (const auto type = find_type(device, allowed, flags)) return *type;
  }
  throw std::runtime_error("no memory type suits a buffer");
}

[[noreturn]] void throw_short(const Device& device, std::uint64_t bytes, const std::string& label,
                              const std::string& why) {
  throw DeviceError(fmt::format("cannot hold {} bytes for {} on {}: {}", bytes, label, device.info.name, why));
}

void check_memory(const Device& device, VkResult result, const char* call, std::uint64_t bytes,
                  const std::string& label) {
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
    throw_short(device, bytes, label, fmt::format("memory is short ({} bytes in all)", device.info.memory_bytes));
  }
  check(result, call);
}

void create_handle(Device& device, Allocation& allocation, VkBufferUsageFlags usage, const std::string& label) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = allocation.bytes;
  info.usage = usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  check_memory(device, vkCreateBuffer(device.handle, &info, nullptr, &allocation.buffer), "vkCreateBuffer",
               allocation.bytes, label);
}

void bind_memory(Device& device, Allocation& allocation, VkBufferUsageFlags usage, Placement placement,
                 const std::string& label) {
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device.handle, allocation.buffer, &needs);
  const std::uint32_t type = choose_type(device, needs.memoryTypeBits, placement);
  const std::uint64_t heap = device.memory.memoryHeaps[device.memory.memoryTypes[type].heapIndex].size;
  if (needs.size > heap)
    throw_short(device, allocation.bytes, label, fmt::format("its memory has {} bytes in all", heap));

  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.pNext = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) ? &flags : nullptr;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = type;
  check_memory(device, vkAllocateMemory(device.handle, &info, nullptr, &allocation.memory), "vkAllocateMemory",
               allocation.bytes, label);
  QUINCUNX_VK(vkBindBufferMemory(device.handle, allocation.buffer, allocation.memory, 0));
  const VkMemoryPropertyFlags has = device.memory.memoryTypes[type].propertyFlags;
  const bool wanted = placement == Placement::staging || device.features.unified_memory;
  if (wanted && (has & kMapped) == kMapped) {
    QUINCUNX_VK(vkMapMemory(device.handle, allocation.memory, 0, VK_WHOLE_SIZE, 0, &allocation.mapped));
  }
}

}  // namespace

bool is_unified(VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU ||
         properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
}

Allocation allocate(Device& device, std::uint64_t bytes, VkBufferUsageFlags usage, Placement placement,
                    const std::string& label) {
  if (bytes > device.max_allocation) {
    throw_short(device, bytes, label, fmt::format("one buffer holds at most {} bytes", device.max_allocation));
  }
  Allocation allocation;
  allocation.bytes = bytes;
  try {
    create_handle(device, allocation, usage, label);
    bind_memory(device, allocation, usage, placement, label);
  } catch (...) {
    release(device, allocation);
    throw;
  }
  return allocation;
}

void release(Device& device, Allocation& allocation) {
  if (allocation.buffer) vkDestroyBuffer(device.handle, allocation.buffer, nullptr);
  if (allocation.memory) vkFreeMemory(device.handle, allocation.memory, nullptr);
  allocation = {};
}

}  // namespace quincunx::gpu

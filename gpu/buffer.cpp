#include "gpu/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "gpu/buffer_owner.h"
#include "gpu/check.h"
#include "gpu/texel_format.h"

namespace quincunx::gpu {
namespace {

void check_limit(const Device& device, std::uint64_t found, std::uint64_t limit, const char* what,
                 const std::string& label) {
  if (found <= limit) return;
  throw DeviceError(fmt::format("{} needs {} {}; {} allows {}", label, found, what, device.info.name, limit));
}

void check_texels(const Device& device, std::uint64_t bytes, VkFormat format, const std::string& label) {
  const std::uint32_t texel = texel_bytes(format);
  if (texel == 0 || bytes < texel) {
    throw std::runtime_error(fmt::format("{}: {} bytes hold no texel of {}", label, bytes, texel_format_name(format)));
  }
  if (!reads_texels(device, format)) {
    throw DeviceError(
        fmt::format("{}: {} has no texel buffers of {}", label, device.info.name, texel_format_name(format)));
  }
  check_limit(device, bytes / texel, device.limits.maxTexelBufferElements, "texels", label);
}

void check_use(const Device& device, std::uint64_t bytes, BufferUse use, VkFormat format, const std::string& label) {
  switch (use) {
    case BufferUse::storage:
      return check_limit(device, bytes, device.limits.maxStorageBufferRange, "bytes of one storage buffer", label);
    case BufferUse::uniform:
      return check_limit(device, bytes, device.limits.maxUniformBufferRange, "bytes of one uniform buffer", label);
    case BufferUse::texel: return check_texels(device, bytes, format, label);
    case BufferUse::address:
      if (!device.features.buffer_address) {
        throw DeviceError(fmt::format("{} needs device addresses, which {} does not have", label, device.info.name));
      }
  }
}

VkBufferUsageFlags usage_flags(const Device& device, BufferUse use) {
  VkBufferUsageFlags flags = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  flags |= use == BufferUse::uniform ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  if (use == BufferUse::texel) flags |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
  if (device.features.buffer_address) flags |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  return flags;
}

VkBufferView create_view(Device& device, VkBuffer buffer, std::uint64_t bytes, VkFormat format) {
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = buffer;
  info.format = format;
  info.range = bytes / texel_bytes(format) * texel_bytes(format);
  VkBufferView view = VK_NULL_HANDLE;
  QUINCUNX_VK(vkCreateBufferView(device.handle, &info, nullptr, &view));
  return view;
}

VkDeviceAddress device_address(const Device& device, VkBuffer buffer) {
  if (!device.features.buffer_address) return 0;
  VkBufferDeviceAddressInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  info.buffer = buffer;
  return vkGetBufferDeviceAddress(device.handle, &info);
}

void fill_with_zeros(Device& device, const Allocation& allocation) {
  if (allocation.mapped) {
    std::memset(allocation.mapped, 0, allocation.bytes);
    return;
  }
  const std::lock_guard lock(device.mutex);
  run_commands(device,
               [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, allocation.buffer, 0, VK_WHOLE_SIZE, 0); });
}

}  // namespace

bool reads_texels(const Device& device, VkFormat format) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(device.physical, format, &properties);
  return (properties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT) != 0;
}

Buffer create_buffer(Device& device, std::uint64_t bytes, BufferUse use, const std::string& label,
                     VkFormat texel_format) {
  if (bytes == 0) bytes = 4;
  check_use(device, bytes, use, texel_format, label);

  auto owner = std::make_shared<BufferOwner>();
  owner->device = device.shared_from_this();
  owner->use = use;
  // Whole words, because vkCmdFillBuffer leaves out what is not; near 2^64 there is no rounding up, nor such a device.
  const std::uint64_t whole = bytes > UINT64_MAX - 3 ? bytes : (bytes + 3) / 4 * 4;
  owner->allocation = allocate(device, whole, usage_flags(device, use), Placement::device, label);
  if (use == BufferUse::texel) owner->view = create_view(device, owner->allocation.buffer, bytes, texel_format);
  fill_with_zeros(device, owner->allocation);

  Buffer buffer;
  buffer.handle = owner->allocation.buffer;
  buffer.view = owner->view;
  buffer.bytes = bytes;
  buffer.address = device_address(device, buffer.handle);
  buffer.owner = std::move(owner);
  return buffer;
}

Buffer create_filled(Device& device, std::span<const std::byte> bytes, BufferUse use, const std::string& label,
                     VkFormat texel_format) {
  Buffer buffer = create_buffer(device, bytes.size(), use, label, texel_format);
  upload(device, buffer, bytes);
  return buffer;
}

}  // namespace quincunx::gpu

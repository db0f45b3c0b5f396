// Device memory for kernels, and the way in and out.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "gpu/device.h"

namespace quincunx::gpu {

/// storage: buffer blocks, at most max_storage_buffer_range bytes.
/// uniform: uniform blocks.
/// texel:   uniform texel buffer (samplerBuffer), read-only for kernels, at most
///          max_texel_buffer_elements; also storage.
/// address: reached by Buffer::address alone (GL_EXT_buffer_reference), as large as memory allows.
enum class BufferUse { storage, uniform, texel, address };

/// A device-local buffer, mapped where the device's memory is the host's. Destroyed with the last copy of the handle.
struct Buffer {
  std::shared_ptr<void> owner;
  VkBuffer handle = VK_NULL_HANDLE;
  VkBufferView view = VK_NULL_HANDLE;  ///< texel buffers only
  std::uint64_t bytes = 0;
  VkDeviceAddress address = 0;  ///< where the device has features().buffer_address, else 0
};

/// Whether kernels of the device can read texel buffers of that format.
bool reads_texels(const Device& device, VkFormat format);

/// Throws DeviceError naming `label` and the bytes where memory is short or a limit (see BufferUse) is passed, where
/// the device cannot read `texel_format`, or has no addresses for BufferUse::address.
/// Contents start as zeros. `bytes` 0 is taken as 4. `texel_format` is for BufferUse::texel alone; bytes after the
/// last whole texel are not seen by samplerBuffers.
Buffer create_buffer(Device& device, std::uint64_t bytes, BufferUse use, const std::string& label,
                     VkFormat texel_format = VK_FORMAT_UNDEFINED);

/// A buffer of these bytes.
Buffer create_filled(Device& device, std::span<const std::byte> bytes, BufferUse use, const std::string& label,
                     VkFormat texel_format = VK_FORMAT_UNDEFINED);

/// Copies to and from the buffer at `offset` in bytes; the data is there when the call returns.
/// Throws std::out_of_range where the bytes do not lie in the buffer.
void upload(Device& device, const Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t offset = 0);
void download(Device& device, const Buffer& buffer, std::span<std::byte> bytes, std::uint64_t offset = 0);

}  // namespace quincunx::gpu

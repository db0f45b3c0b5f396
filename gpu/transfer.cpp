// Upload and download: through the mapping where there is one, else by copies of at most kChunk bytes through one
// staging buffer that the device keeps.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "gpu/buffer.h"
#include "gpu/buffer_owner.h"

namespace quincunx::gpu {
namespace {

constexpr std::uint64_t kChunk = std::uint64_t{32} << 20;

void check_range(const Buffer& buffer, std::uint64_t bytes, std::uint64_t offset, const char* what) {
  if (offset <= buffer.bytes && bytes <= buffer.bytes - offset) return;
  throw std::out_of_range(fmt::format("{} of {} bytes at {}: the buffer has {}", what, bytes, offset, buffer.bytes));
}

// The staging buffer, at least `bytes` (at most kChunk) large. The caller holds device.mutex.
Allocation& staging(Device& device, std::uint64_t bytes) {
  const std::uint64_t wanted = std::min(kChunk, std::max<std::uint64_t>(bytes, 1 << 16));
  if (device.staging.bytes < wanted) {
    release(device, device.staging);
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    device.staging = allocate(device, wanted, usage, Placement::staging, "copies to and from the device");
  }
  return device.staging;
}

void copy(Device& device, VkBuffer from, VkBuffer to, const VkBufferCopy& region) {
  run_commands(device, [&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, from, to, 1, &region); });
}

}  // namespace

void upload(Device& device, const Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t offset) {
  check_range(buffer, bytes.size(), offset, "upload");
  if (bytes.empty()) return;
  const std::lock_guard lock(device.mutex);
  if (void* mapped = owner_of(buffer).allocation.mapped) {
    std::memcpy(static_cast<std::byte*>(mapped) + offset, bytes.data(), bytes.size());
    return;
  }
  const Allocation& stage = staging(device, bytes.size());
  for (std::uint64_t done = 0; done < bytes.size();) {
    const std::uint64_t count = std::min<std::uint64_t>(stage.bytes, bytes.size() - done);
    std::memcpy(stage.mapped, bytes.data() + done, count);
    copy(device, stage.buffer, buffer.handle, {0, offset + done, count});
    done += count;
  }
}

void download(Device& device, const Buffer& buffer, std::span<std::byte> bytes, std::uint64_t offset) {
  check_range(buffer, bytes.size(), offset, "download");
  if (bytes.empty()) return;
  const std::lock_guard lock(device.mutex);
  if (const void* mapped = owner_of(buffer).allocation.mapped) {
    std::memcpy(bytes.data(), static_cast<const std::byte*>(mapped) + offset, bytes.size());
    return;
  }
  const Allocation& stage = staging(device, bytes.size());
  for (std::uint64_t done = 0; done < bytes.size();) {
    const std::uint64_t count = std::min<std::uint64_t>(stage.bytes, bytes.size() - done);
    copy(device, buffer.handle, stage.buffer, {offset + done, 0, count});
    std::memcpy(bytes.data() + done, stage.mapped, count);
    done += count;
  }
}

}  // namespace quincunx::gpu

// What keeps a Buffer alive. Private to gpu/.
#pragma once

#include <memory>

#include "gpu/buffer.h"
#include "gpu/device_state.h"

namespace quincunx::gpu {

struct BufferOwner {
  std::shared_ptr<Device> device;
  Allocation allocation;
  VkBufferView view = VK_NULL_HANDLE;
  BufferUse use = BufferUse::storage;

  BufferOwner() = default;
  BufferOwner(const BufferOwner&) = delete;
  BufferOwner& operator=(const BufferOwner&) = delete;
  ~BufferOwner() {
    if (view) vkDestroyBufferView(device->handle, view, nullptr);
    release(*device, allocation);
  }
};

inline const BufferOwner& owner_of(const Buffer& buffer) {
  return *static_cast<const BufferOwner*>(buffer.owner.get());
}

}  // namespace quincunx::gpu

// A Vulkan device by the name that --device gives it.
#pragma once

#include <memory>
#include <string>

#include "gpu/gpu.h"

namespace quincunx {

/// Throws gpu::DeviceError where there is none.
inline std::shared_ptr<gpu::Device> open_device(const std::string& select) {
  gpu::DeviceConfig config;
  config.select = select;
  return gpu::open_device(config);
}

}  // namespace quincunx

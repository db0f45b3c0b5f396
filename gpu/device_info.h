// What Vulkan devices there are, and which of them a user means.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quincunx::gpu {

struct DeviceInfo {
  std::uint32_t index = 0;         ///< position in the list, what --device takes
  std::string name, driver, type;  ///< type: "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
  std::uint32_t api_version = 0;
  std::uint64_t memory_bytes = 0;  ///< largest device-local heap
  std::uint64_t max_storage_buffer_range = 0, max_texel_buffer_elements = 0;
  bool usable = false;  ///< Vulkan 1.2 or later with a compute queue and timestamps
};

/// All Vulkan devices in the loader's order; empty where there is no driver.
std::vector<DeviceInfo> list_devices();

/// The position in `devices` that `select` means.
///   select  "": the first usable one of the best type, discrete before integrated before virtual before CPU;
///           digits: that index; else the best of those whose name holds `select` (case ignored).
/// Throws DeviceError that lists the devices where there is none such or it is not usable.
std::uint32_t choose_device(std::span<const DeviceInfo> devices, const std::string& select);

}  // namespace quincunx::gpu

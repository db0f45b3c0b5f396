// A Vulkan device opened for compute.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gpu/device_info.h"
#include "gpu/error.h"

namespace quincunx::gpu {

/// How data reaches the device: mapped memory where it is the host's as well, else copies through a staging buffer.
enum class Transfer { automatic, staged };

struct DeviceConfig {
  std::string select;       ///< as choose_device takes it
  bool validation = false;  ///< turn the validation layer on; its messages are collected (validation_messages)
  bool gpu_assisted = false;  ///< with validation, kernels also check what they index: takes them long to compile
  /// Of SPIR-V and the pipeline cache; "": quincunx in $XDG_CACHE_HOME or ~/.cache. Unwritable: no cache.
  std::string cache_folder;
  Transfer transfer = Transfer::automatic;  ///< staged: as on a discrete GPU, whatever the memory
};

/// What of the optional features the device has; all that it has are on.
struct DeviceFeatures {
  bool float64 = false, int64 = false, int8 = false;
  bool storage8 = false;        ///< bytes in storage buffers
  bool buffer_address = false;  ///< Buffer::address, GL_EXT_buffer_reference
  bool scalar_layout = false;   ///< GL_EXT_scalar_block_layout
  bool robust_access = false;   ///< only with validation: it costs time
  bool unified_memory = false;  ///< buffers are mapped, nothing is staged
};

/// Owns instance, device, queue, command pool and pipeline cache; neither copied nor moved. Buffers and pipelines
/// keep their device alive. Calls from several threads are put one after another.
class Device;

/// Throws DeviceError where there is no such device, or validation is asked for and not installed.
std::shared_ptr<Device> open_device(const DeviceConfig& config);
const DeviceInfo& info(const Device& device);
const DeviceFeatures& features(const Device& device);
/// Warnings and errors the validation layer gave since the device was opened; empty means silent.
/// What it says while the device is being closed (objects never destroyed) goes to stderr.
std::vector<std::string> validation_messages(const Device& device);

}  // namespace quincunx::gpu

// The driver's pipeline cache, kept on disk per device and driver version. Private to gpu/.
#pragma once

namespace quincunx::gpu {

class Device;

/// Starts from what an earlier run kept, else empty.
void load_pipeline_cache(Device& device);
/// Keeps it where it has grown since it was loaded; never throws.
void save_pipeline_cache(Device& device) noexcept;

}  // namespace quincunx::gpu

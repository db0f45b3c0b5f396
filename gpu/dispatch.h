// Running a kernel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pipeline.h"

namespace quincunx::gpu {

/// Resources by the kernel's names; one missing, one too many or one of the wrong use is a
/// std::runtime_error naming it.
using Resources = std::vector<std::pair<std::string, Buffer>>;

/// Runs the kernel over groups, waits for its end (all barriers inside), and returns its time in milliseconds by
/// timestamp queries. `push` is copied to the push constants and must have their size. No groups, no work: 0.
/// Throws DeviceError where the device does not allow so many groups.
double dispatch(Device& device, const Pipeline& pipeline, const Resources& resources, std::span<const std::byte> push,
                std::uint32_t groups_x, std::uint32_t groups_y = 1, std::uint32_t groups_z = 1);

}  // namespace quincunx::gpu

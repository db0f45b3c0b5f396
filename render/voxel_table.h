// The transfer function of voxels: one entry for each density that one can hold.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "accel/voxels.h"
#include "render/transfer_function.h"

namespace quincunx {

/// A voxel's extinction along one world unit, -ln(1 - opacity) / unit, the opacity at most 1 - 2^-24. `unit` counts where the function has none.
double voxel_extinction(const TransferFunction& function, double value, double unit);

/// Entry n is that of the density n: linear r, g, b and the extinction along `length` (world). Exactly 0 where the opacity is.
std::vector<glm::vec4> voxel_table(const TransferFunction& function, const VoxelScale& scale, double unit, double length);

/// The least value to which the function gives opacity, or that next to the last one from which on it does; infinite where it gives none, and
/// negative infinity where it does from the start.
double least_visible(const TransferFunction& function);

}  // namespace quincunx

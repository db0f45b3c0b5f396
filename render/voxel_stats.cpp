#include "render/voxel_stats.h"

#include "accel/voxels.h"

namespace quincunx {

VoxelStats voxel_stats(const Voxels& voxels) {
  VoxelStats stats;
  stats.shape = voxels.shape == VoxelShape::cuboid ? "cuboid" : "sphere";
  stats.voxels = voxels.size();
  stats.samples = voxels.samples;
  stats.grid_bytes = voxels.sample_bytes;
  stats.leaf_bytes = voxels.data.size() * sizeof(VoxelData);
  stats.place_bytes = voxels.place_bytes();
  return stats;
}

}  // namespace quincunx

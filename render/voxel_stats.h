// What the voxels of a picture take.
#pragma once

#include <cstdint>
#include <string>

namespace quincunx {

struct Voxels;

/// Counts and bytes. Nodes are 0 where there is no tree (`--device cpu`).
struct VoxelStats {
  std::string shape;         ///< cuboid or sphere
  std::uint64_t voxels = 0;  ///< leaves' primitives
  std::uint64_t samples = 0, grid_bytes = 0;  ///< of the grid that they were made of, as samples of the volume's type; 0 bytes for particles
  std::uint64_t nodes = 0, one_child = 0;     ///< of the tree; those that have one child alone
  int depth = 0;               ///< nodes from the root to the deepest leaf
  std::uint64_t leaf_bytes = 0, place_bytes = 0, node_bytes = 0;  ///< densities and gradients, where the voxels are, the tree
};

/// All but the tree's.
VoxelStats voxel_stats(const Voxels& voxels);

}  // namespace quincunx

// The flags of `quincunx render --render bih`: voxels in place of a spline.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace quincunx {

/// What a volume is seen as: a spline of its samples, or voxels in a bounding interval hierarchy.
enum class RenderWay { spline, bih };

struct VoxelFlags {
  std::optional<RenderWay> way;     ///< none: bih for particles, else spline
  std::optional<double> minimum;    ///< --bih-min; none: what the transfer function shows
  std::optional<double> deviation;  ///< --bih-lod; none: nothing is merged
  int leaf = 1;                     ///< --bih-leaf: voxels of a leaf of the tree, at most
  double supersample = 1.0;         ///< samples per axis in place of one
  std::string particles;            ///< --particles, a file; empty: a volume
  std::optional<double> radius;     ///< --radius, of particles without their own, world units

  bool voxels() const { return way.value_or(particles.empty() ? RenderWay::spline : RenderWay::bih) == RenderWay::bih; }
};

/// --render, --bih-min, --bih-lod, --bih-leaf, --supersample, --particles, --radius.
void add_voxel_flags(CLI::App& app, VoxelFlags& flags);

/// Throws InputError naming the first flag given to `app`, the render command, that means nothing with the way to render: any but those of the picture, the camera, the transfer
/// function and the device with voxels, those of voxels without.
void check_voxel_flags(const CLI::App& app, const VoxelFlags& flags, const std::string& volume, const std::string& transfer_function);

}  // namespace quincunx

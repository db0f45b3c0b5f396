// The voxels of a volume: a cuboid about each sample that is dense enough, and larger ones in place of several alike.
#pragma once

#include <limits>
#include <optional>

#include "accel/voxels.h"
#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// On the Cartesian lattice a sample's cuboid is the cell-sized cube about it. On the BCC lattice it is 2 x 2 x 1 cells: those of all samples fill space without
/// overlapping, layer by layer along z, and their volume is that of the truncated octahedra which they stand for. Cuboids at the border reach beyond the domain.
struct VoxelConfig {
  double minimum = -std::numeric_limits<double>::infinity();  ///< samples below it are no voxels, nor are NaNs and infinities
  /// Level of detail: siblings (the eight halves of a cube; on the BCC lattice the four of a square of one coset's layer), all of them voxels, become
  /// one of their mean density and gradient as long as no sample in it differs from the mean by more than this (data units). None: not merged.
  std::optional<double> deviation;
};

/// Gradients are central differences of neighbouring samples along the axes of a coset, one-sided where a neighbour is missing or not finite.
/// Siblings stand side by side, so that neighbours in the list are neighbours in space. Throws InputError where an axis has more than 32766 cells.
Voxels volume_voxels(const Volume& volume, const VoxelConfig& config, const Progress& progress = {});

}  // namespace quincunx

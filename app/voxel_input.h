// What `quincunx render --render bih` shows, read and made.
#pragma once

#include "accel/voxels.h"
#include "app/progress_bar.h"
#include "app/render_flags.h"
#include "lattice/volume.h"

namespace quincunx {

struct VoxelInput {
  Volume volume;  ///< as it was read; of particles lattice, extents and world of their box alone
  Voxels voxels;
  double read_ms = 0.0, resample_ms = 0.0, voxels_ms = 0.0;
};

/// Reads the volume or the particles and makes voxels of them. Throws InputError naming the file or flag.
VoxelInput read_voxels(const RenderFlags& flags, ProgressBar& bar);

}  // namespace quincunx

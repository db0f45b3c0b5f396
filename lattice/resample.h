// From one lattice to the other.
#pragma once

#include <string_view>

#include "lattice/volume.h"

namespace quincunx {

/// The even and the odd points of a Cartesian volume as a BCC volume: each coset has floor(size/2)
/// samples per axis, and every sample keeps its value, type and place in the world.
/// Throws InputError naming `what` where an axis has fewer than 2 samples or `cartesian` is not Cartesian.
Volume bcc_subset(const Volume& cartesian, std::string_view what = "volume");

/// The even coset of a BCC volume as a Cartesian volume (1/2 of the samples, same type, same places).
/// Throws InputError where `bcc` is not BCC.
Volume cartesian_subset(const Volume& bcc);

}  // namespace quincunx

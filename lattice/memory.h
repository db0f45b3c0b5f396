// How many samples there are, and whether they can be held at all: asked before anything is allocated.
#pragma once

#include <cstdint>
#include <string_view>

#include "lattice/volume.h"

namespace quincunx {

/// coset_count * nx*ny*nz. Throws InputError, naming `what` (a file or a flag), unless every extent is at least 1 and
/// the samples' bytes are fewer than 2^62.
std::uint64_t checked_sample_count(LatticeKind lattice, const Extents& extents, SampleType type, std::string_view what);

/// This machine's.
std::uint64_t memory_bytes();

/// Throws InputError, naming `what`, where `bytes` are more than this machine's memory.
void check_fits_memory(std::uint64_t bytes, std::string_view what);

}  // namespace quincunx

// Where an NRRD header places its samples.
#pragma once

#include "io/nrrd_text.h"
#include "lattice/lattice.h"

namespace quincunx {

/// The world of a header's `spacings` or `space directions`, and `space origin`. `dimension` is 3, or 4 for bcc.
/// Throws InputError for anything malformed, not finite or singular.
World interpret_world(const NrrdText& text, LatticeKind lattice, int dimension);

/// True for the name of a three-dimensional space of the format, such as left-posterior-superior or LPS.
bool is_space_name(std::string_view name);

/// Throws InputError, naming `what`, unless the three axes are finite and span the space.
void check_world(const World& world, const std::string& what);

}  // namespace quincunx

// Blocks to cluster where there is no volume: made up, of the characters that D. Ganter and M. Manzke tell apart (accel/cluster.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "accel/classification.h"

namespace quincunx {

/// The names generated_mask knows: strands, solid parts, vessels, gyroid, noise.
const std::vector<std::string_view>& mask_names();

/// The mask of that name, of edge^3 blocks, edge >= 1. A function of name and edge alone.
///   strands      curves one to two blocks in radius at any edge, as many as make a twelfth of the blocks active
///   solid parts  filled ellipsoids that scale with the edge, as many as make a seventh of the blocks active
///   vessels      three filled trees; radii divide by Murray's law from a trunk that scales with the edge down to less than a block
///   gyroid       the sheets of a gyroid, three periods along an edge, about two blocks thick
///   noise        one block in ten, each by itself
/// Throws InputError naming the choices.
Classification generated_mask(std::string_view name, int edge);

}  // namespace quincunx

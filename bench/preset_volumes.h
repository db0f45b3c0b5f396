// Made-up volumes in place of the data sets of publications, which are not public or not named: of the same character.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// Samples, and from which value on they are seen.
struct PresetVolume {
  std::string name;
  Volume volume;
  double threshold = 128.0;  ///< less has no opacity
  double soft = 64.0;        ///< the values above it over which opacity grows to its most
};

/// The names generated_volume knows: strands, solid parts, vessels, points, waves.
const std::vector<std::string_view>& preset_volume_names();

/// The volume of that name on `lattice`, of `cells` cells along an axis (BCC: one less where that is even), at least 8, 8-bit samples. A function of the
/// arguments alone. Of the first four "active" are blocks of 4 cells that hold a sample of the threshold or more.
///   strands      curves 2 to 4 cells in radius at any size, as many as make a twelfth of the blocks active; values fall linearly with the distance from their axes
///   solid parts  filled ellipsoids that scale with the volume, as many as make a seventh of the blocks active
///   vessels      three filled trees; radii divide by Murray's law, from a 24th of the volume's edge down to one cell
///   points       density of points that crowd about 32 centres, as of N bodies, as many as make a twelfth of the blocks active
///   waves        a sum of 16 plane waves, smooth everywhere: any part of the blocks is active at some threshold
/// Throws InputError naming the choices.
PresetVolume generated_volume(std::string_view name, LatticeKind lattice, int cells, const Progress& progress = {});

/// Balls of `radius` cells about `count` middles, those of fewer balls among those of more: what grows and what becomes more.
PresetVolume generated_balls(int count, double radius, LatticeKind lattice, int cells);

}  // namespace quincunx

// A spline sampled on another lattice.
#pragma once

#include "lattice/progress.h"
#include "lattice/target_grid.h"
#include "spline/spline.h"

namespace quincunx {

/// The values of the spline of coefficients `c` at the points of `grid`, whose axes have the directions and the origin of the coefficients' world
/// and whose domain is inside theirs, as samples of `type`: floats, or the nearest integers that the type has. In double precision, in
/// parallel. Throws InputError where there are too many samples for this machine's memory ("--dims") or one is too large for a float.
Volume spline_samples(const Spline& spline, const Coefficients<double>& c, const TargetGrid& grid, SampleType type, const Progress& progress = {});

}  // namespace quincunx

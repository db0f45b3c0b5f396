// Which values leave a trace in a picture: what blocks and cells are classified by.
#pragma once

#include <vector>

#include "accel/value_range.h"
#include "render/scene.h"
#include "spline/value_unit.h"

namespace quincunx {

/// The isovalues of visible surfaces, and the values to which a volume's table gives opacity; at most 254 ranges, close ones joined where
/// there are more. Exact for the table as kernels interpolate it, rounding included. Throws InputError as bake does.
std::vector<ValueRange> seen_values(const Scene& scene);

/// The isovalue as kernels have it: a float in the coefficients' unit, kept within what kernels can scale.
float kernel_isovalue(double isovalue, const ValueUnit& unit);

/// Ranges of values in `unit`: isovalues as kernels have them, the ends of others rounded outwards.
std::vector<ValueRange> numbers_of(std::vector<ValueRange> values, const ValueUnit& unit);

}  // namespace quincunx

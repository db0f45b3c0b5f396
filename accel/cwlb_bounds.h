// Bounds of the cosine-weighted linear B-spline over cells.
#pragma once

#include "accel/bounds_margin.h"

namespace quincunx {

/// The margin for points displaced by up to `displacement` cells (1-norm).
Margin cwlb_margin(double displacement);

/// Fills `bounds`, whose cells and room are those of `c`; bcc, apron >= 1.
void cwlb_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds);

}  // namespace quincunx

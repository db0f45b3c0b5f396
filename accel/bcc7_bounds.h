// Bounds of the bcc7 spline over cells.
#pragma once

#include "accel/bounds_margin.h"

namespace quincunx {

/// The margin for points displaced by up to `displacement` cells (1-norm).
Margin bcc7_margin(double displacement);

/// Fills `bounds`, whose cells and room are those of `c`; bcc, apron >= 1.
void bcc7_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds);

}  // namespace quincunx

// Bounds of the box splines of the BCC lattice over cells.
#pragma once

#include "accel/bounds_margin.h"

namespace quincunx {

/// The margins for points displaced by up to `displacement` cells (1-norm).
Margin bcc4_margin(double displacement);
Margin bcc7_margin(double displacement);
Margin bcc8_margin(double displacement);

/// Fill `bounds`, whose cells and room are those of `c`; bcc, with the spline's apron or more.
void bcc4_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds);
void bcc7_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds);
void bcc8_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds);

}  // namespace quincunx

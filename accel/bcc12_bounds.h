// Bounds of the bcc12 spline over cells.
#pragma once

#include "accel/bounds_margin.h"

namespace quincunx {

/// The margin for points displaced by up to `displacement` cells (1-norm).
Margin bcc12_margin(double displacement);

/// Fills `bounds`, whose cells and room are those of `c`: bcc, with the apron of the spline (Spline::apron).
void bcc12_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress, CellBounds& bounds);

}  // namespace quincunx

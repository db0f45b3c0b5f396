// Bounds of the splines that are products along the axes of a Cartesian lattice.
#pragma once

#include "accel/bounds_margin.h"

namespace quincunx {

/// The margins for points displaced by up to `displacement` cells (1-norm).
Margin trilinear_margin(double displacement);
Margin triquadratic_margin(double displacement);
Margin tricubic_margin(double displacement);
Margin catmull_rom_margin(double displacement);

/// Fill `bounds`, whose cells and room are those of `c`: cartesian, with the apron of the spline (Spline::apron).
void trilinear_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                      const Progress& progress, CellBounds& bounds);
void triquadratic_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                         const Progress& progress, CellBounds& bounds);
void tricubic_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                     const Progress& progress, CellBounds& bounds);
void catmull_rom_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                        const Progress& progress, CellBounds& bounds);

}  // namespace quincunx

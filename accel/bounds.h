// Certain bounds of a spline's values over cells.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/value_range.h"
#include "lattice/progress.h"
#include "spline/spline.h"

namespace quincunx {

/// For each cell (unit cube of lattice coordinates, lower corner (x,y,z), 0 <= x < cells.x ...) an interval that
/// certainly contains every value the spline takes on the closed cell, and every value that a kernel in 32-bit
/// floats computes there or, at a point of the cell's boundary, from a neighbouring cell.
///
/// The interval is the range of the Bernstein-Bezier net over the cell (convex hull property; of cwlb that of values it is a mean of), widened by the
/// rounding margin of its spline (bounds.cpp), then rounded outwards to 16 bits on its scale. An empty one (min > max) has no value that
/// could be seen: that of a void cell (void_cells.h).
struct CellBounds : ValueScale {
  glm::i64vec3 cells{0};  ///< cell_count of the volume
  std::vector<std::uint16_t> min, max;  ///< x fastest

  std::size_t number(const glm::i64vec3& c) const { return std::size_t((c.z * cells.y + c.y) * cells.x + c.x); }
};

/// What 16-bit numbers mean, and what margins suppose, for all boxes of a volume alike.
struct BoundsScale : ValueScale {
  double least = 0.0, most = 0.0;  ///< that a coefficient of the volume can be
  double displacement = 0.0;       ///< cells, 1-norm: of the point that a kernel computes from the one it means
};

/// Bounds of the spline of coefficients `c` over all their cells, computed in parallel.
/// Throws std::logic_error for a spline that has none here.
CellBounds cell_bounds(const Spline& spline, const Coefficients<float>& c, const Progress& progress = {});

/// K: a kernel's value of the spline is within K e m of the exact one, e = 2^-24, m the largest |coefficient| that reaches the cell or one of
/// its neighbours. The derivation is in the file of the spline's bounds.
double kernel_rounding(const Spline& spline);

/// The largest distance (1-norm, cells) between a point that a kernel means and the one it computes, in a volume of so many cells.
double ray_displacement(const glm::i64vec3& cells);

/// The scale for any coefficients that a prefilter of the spline can make of samples from `sample_min` to `sample_max`, and for
/// a volume of `cells` (cell_count of all of it).
BoundsScale bounds_scale(const Spline& spline, Spline::Prefilter prefilter, double sample_min, double sample_max, const glm::i64vec3& cells);

/// How much wider, on either side, bounds have to be for any spline each of whose coefficients is within `error` of one that they are for.
double value_error(const Spline& spline, const BoundsScale& scale, double error);

/// Bounds on `scale` over the cells of a box cut out of a volume, certain for each cell whose coefficients are the volume's: those that
/// reach it, no farther, all within the box's extents; of bcc4, whose slope jumps, those that reach its neighbours as well, within the box's
/// apron at the farthest. What is outside the box may be anything that the scale allows.
CellBounds cell_bounds(const Spline& spline, const Coefficients<float>& c, const BoundsScale& scale);

}  // namespace quincunx

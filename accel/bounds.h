// Certain bounds of a spline's values over cells.
#pragma once

#include <cstdint>
#include <vector>

#include "lattice/progress.h"
#include "spline/coefficients.h"

namespace quincunx {

/// For each cell (unit cube of lattice coordinates, lower corner (x,y,z), 0 <= x < cells.x ...) an interval that
/// certainly contains every value the spline takes on the closed cell, and every value that a kernel in 32-bit
/// floats computes there or, at a point of the cell's boundary, from a neighbouring cell.
///
/// The interval is the range of the Bernstein-Bezier net over the cell (convex hull property), widened by the
/// rounding margin of bounds.cpp, then rounded outwards to 16 bits: value(q) = low + q * step, exactly as computed
/// in double.
struct CellBounds {
  glm::i64vec3 cells{0};  ///< domain_max of the volume; an axis of one sample has one cell (see bounds.cpp)
  double low = 0.0, step = 1.0;
  std::vector<std::uint16_t> min, max;  ///< x fastest

  double value(std::uint16_t q) const { return low + double(q) * step; }
  std::size_t number(const glm::i64vec3& c) const { return std::size_t((c.z * cells.y + c.y) * cells.x + c.x); }
};

/// Bounds of the bcc7 spline, computed in parallel.
CellBounds bcc7_bounds(const Coefficients<float>& c, const Progress& progress = {});

}  // namespace quincunx

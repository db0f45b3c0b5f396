// Cells in which nothing is seen, because a sample that is NaN or infinite has a weight there.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/bounds.h"
#include "lattice/not_finite.h"
#include "spline/spline.h"

namespace quincunx {

/// The void cells of a volume: those with a point, in the closed cell, at which a sample that is not finite has a weight. What the prefilter
/// reaches beside that does not count. One bit a cell, laid out as CellOccupancy.
struct VoidCells {
  glm::i64vec3 cells{0};  ///< cell_count of the volume
  glm::i64vec3 bricks{0};
  std::vector<std::uint64_t> words;  ///< none where no cell is void
  std::uint64_t count = 0;           ///< of void cells

  /// `cell` is one of the volume's.
  bool at(const glm::i64vec3& cell) const {
    if (words.empty()) return false;
    const glm::i64vec3 b = cell >> std::int64_t(2), r = cell & std::int64_t(3);
    return words[std::size_t((b.z * bricks.y + b.y) * bricks.x + b.x)] >> (r.z * 16 + r.y * 4 + r.x) & 1;
  }
};

/// Those of the spline through the volume's samples, which are on its lattice. Computed in parallel.
VoidCells void_cells(const Spline& spline, const Volume& volume);

/// Makes the samples finite as `policy` says: an extension of the finite ones (extend_finite) or a value instead of the others. The void cells
/// of NanPolicy::empty; none, and nothing is done, for NanPolicy::refuse.
VoidCells make_finite(Volume& volume, const Spline& spline, const NanPolicy& policy);

/// Leaves no value in void cells: their intervals become empty.
void leave_out(const VoidCells& voids, CellBounds& bounds);

}  // namespace quincunx

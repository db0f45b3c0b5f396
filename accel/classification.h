// Which blocks may hold a surface: the one decision that every skipping structure relies on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/bounds.h"

namespace quincunx {

/// Min/max of bounds over blocks of block^3 cells (the last block of an axis may be smaller); depends on the
/// volume and the block size alone, so that a change of isovalue does not rebuild it.
struct BlockBounds {
  int block = 1;                ///< edge in cells, a power of two, 1..256
  glm::i64vec3 blocks{0};
  std::vector<std::uint16_t> min, max;  ///< quantised like CellBounds, x fastest
};
BlockBounds block_bounds(const CellBounds& cells, int block);

/// Block levels for a set of isovalues.
struct Classification {
  /// A block that may hold a surface. Any other level is the number of isovalues at or below every value in the block:
  /// between which two isovalues it lies.
  static constexpr std::uint8_t active = 255;

  int block = 1;
  glm::i64vec3 blocks{0};
  std::vector<std::uint8_t> level;  ///< x fastest
  std::size_t active_blocks = 0;
};

/// Classifies blocks for `isovalues`, ascending, at most 254 of them. A block whose interval touches an isovalue is active.
Classification classify(const BlockBounds& bounds, const CellBounds& scale, std::span<const double> isovalues);

/// One bit per cell: set where the cell's own interval touches an isovalue. Bricks of 4x4x4 cells, x fastest; bit
/// z*16 + y*4 + x of a brick's word for the cell (x,y,z) in it. Cells outside the volume are 0.
struct CellOccupancy {
  glm::i64vec3 bricks{0};
  std::vector<std::uint64_t> words;
  std::size_t active_cells = 0;
};
CellOccupancy occupancy(const CellBounds& bounds, std::span<const double> isovalues);

}  // namespace quincunx

// Which blocks may hold something to be seen, a surface or opacity: the one decision that every skipping structure relies on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/bounds.h"
#include "accel/skip_config.h"

namespace quincunx {

/// Min/max of bounds over blocks of block^3 cells (the last block of an axis may be smaller); depends on the
/// volume and the block size alone, so that a change of isovalue or transfer function does not rebuild it.
struct BlockBounds {
  int block = 1;                ///< edge in cells, a power of two, 1..256
  glm::i64vec3 blocks{0};
  std::vector<std::uint16_t> min, max;  ///< quantised like CellBounds, x fastest; min > max where all cells are void
};
BlockBounds block_bounds(const CellBounds& cells, int block);
/// Throws InputError naming --block unless blocks may be of that size.
void check_block(int block);
/// The same of larger blocks, made of smaller ones; `block` is a multiple of theirs.
BlockBounds coarser(const BlockBounds& blocks, int block);

/// Block levels for ranges of values.
struct Classification {
  /// A block that may hold something. Any other level is the number of ranges below every value in the block:
  /// between which two ranges it lies; of a block without values, all of it void, it says nothing.
  static constexpr std::uint8_t active = 255;

  int block = 1;
  glm::i64vec3 blocks{0};
  std::vector<std::uint8_t> level;  ///< x fastest
  std::size_t active_blocks = 0;
};

/// Classifies blocks for `ranges`, at most 254 of them. A block whose interval touches one, in the eyes of `query`, is active.
Classification classify(const BlockBounds& bounds, const ValueScale& scale, std::span<const ValueRange> ranges,
                        RangeQueryKind query = RangeQueryKind::intervals);

/// One bit per cell: set where the cell's own interval touches a range. Bricks of 4x4x4 cells, x fastest; bit
/// z*16 + y*4 + x of a brick's word for the cell (x,y,z) in it. Cells outside the volume are 0.
struct CellOccupancy {
  glm::i64vec3 bricks{0};
  std::vector<std::uint64_t> words;
  std::size_t active_cells = 0;
};
CellOccupancy occupancy(const CellBounds& bounds, std::span<const ValueRange> ranges,
                        RangeQueryKind query = RangeQueryKind::intervals);

}  // namespace quincunx

// Min/max of bounds over blocks of cells.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "accel/classification.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr int kMostBlock = 256;
constexpr int kFirstBlock = 16;  // larger blocks are made of these, so that there are rows for all threads

/// A grid of quantised intervals, x fastest.
struct Grid {
  glm::i64vec3 size;
  const std::uint16_t *min, *max;
};

glm::i64vec3 block_count(const glm::i64vec3& size, int factor) {
  return (size + std::int64_t(factor - 1)) / std::int64_t(factor);
}

/// Reduces the rows y0 <= y < y1, z0 <= z < z1 of `grid` to one row of blocks. `low` and `high` hold grid.size.x
/// numbers.
void reduce_rows(const Grid& grid, int factor, std::int64_t y0, std::int64_t y1, std::int64_t z0, std::int64_t z1,
                 std::uint16_t* low, std::uint16_t* high, std::uint16_t* min, std::uint16_t* max) {
  const std::int64_t n = grid.size.x;
  std::fill(low, low + n, std::uint16_t(65535));
  std::fill(high, high + n, std::uint16_t(0));
  for (std::int64_t z = z0; z < z1; ++z)
    for (std::int64_t y = y0; y < y1; ++y) {
      const std::uint16_t* from_min = grid.min + (z * grid.size.y + y) * n;
      const std::uint16_t* from_max = grid.max + (z * grid.size.y + y) * n;
      for (std::int64_t x = 0; x < n; ++x) low[x] = std::min(low[x], from_min[x]);
      for (std::int64_t x = 0; x < n; ++x) high[x] = std::max(high[x], from_max[x]);
    }
  for (std::int64_t x = 0; x < n; x += factor) {
    const std::int64_t end = std::min<std::int64_t>(x + factor, n);
    *min++ = *std::min_element(low + x, low + end);
    *max++ = *std::max_element(high + x, high + end);
  }
}

/// Reduces cubes of factor^3 entries to one.
void reduce(const Grid& grid, int factor, std::vector<std::uint16_t>& min, std::vector<std::uint16_t>& max) {
  const glm::i64vec3 blocks = block_count(grid.size, factor);
  min.resize(std::size_t(blocks.x * blocks.y * blocks.z));
  max.resize(min.size());
  tbb::parallel_for(std::int64_t(0), blocks.y * blocks.z, [&](std::int64_t row) {
    thread_local std::vector<std::uint16_t> scratch;
    scratch.resize(std::size_t(2 * grid.size.x));
    const std::int64_t y = row % blocks.y * factor, z = row / blocks.y * factor;
    reduce_rows(grid, factor, y, std::min(y + factor, grid.size.y), z, std::min(z + factor, grid.size.z),
                scratch.data(), scratch.data() + grid.size.x, min.data() + row * blocks.x, max.data() + row * blocks.x);
  });
}

}  // namespace

void check_block(int block) {
  if (block < 1 || block > kMostBlock || !std::has_single_bit(unsigned(block)))
    throw InputError(fmt::format("--block: found {}, expected a power of two from 1 to {}", block, kMostBlock));
}

BlockBounds block_bounds(const CellBounds& cells, int block) {
  check_block(block);
  BlockBounds bounds;
  bounds.block = block;
  bounds.blocks = block_count(cells.cells, block);
  const Grid grid{cells.cells, cells.min.data(), cells.max.data()};
  if (block == 1) {
    bounds.min = cells.min, bounds.max = cells.max;
  } else if (block <= kFirstBlock) {
    reduce(grid, block, bounds.min, bounds.max);
  } else {
    std::vector<std::uint16_t> min, max;
    reduce(grid, kFirstBlock, min, max);
    reduce({block_count(cells.cells, kFirstBlock), min.data(), max.data()}, block / kFirstBlock, bounds.min,
           bounds.max);
  }
  return bounds;
}

BlockBounds coarser(const BlockBounds& blocks, int block) {
  const int factor = block / blocks.block;
  BlockBounds bounds{block, block_count(blocks.blocks, factor), {}, {}};
  reduce({blocks.blocks, blocks.min.data(), blocks.max.data()}, factor, bounds.min, bounds.max);
  return bounds;
}

}  // namespace quincunx

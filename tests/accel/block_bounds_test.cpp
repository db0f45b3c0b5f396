#include <gtest/gtest.h>

#include <algorithm>

#include "accel/classification.h"
#include "coefficient_sets.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

TEST(BlockBounds, AreTheMinAndMaxOfTheirCellsForEveryBlockSize) {
  for (const Extents& extents : {Extents(19, 11, 7), Extents(1, 1, 140), Extents(150, 2, 1), Extents(1, 1, 1)}) {
    const CellBounds cells = bounds_of(smooth_coefficients(extents));
    for (int block = 1; block <= 256; block *= 2) {
      const BlockBounds b = block_bounds(cells, block);
      ASSERT_EQ(b.blocks, (cells.cells + std::int64_t(block - 1)) / std::int64_t(block));
      ASSERT_EQ(b.block, block);
      std::vector<std::uint16_t> min(b.min.size(), 65535), max(b.max.size(), 0);
      ASSERT_EQ(std::int64_t(min.size()), b.blocks.x * b.blocks.y * b.blocks.z);
      for (std::int64_t z = 0; z < cells.cells.z; ++z)
        for (std::int64_t y = 0; y < cells.cells.y; ++y)
          for (std::int64_t x = 0; x < cells.cells.x; ++x) {
            const std::size_t to = std::size_t((z / block * b.blocks.y + y / block) * b.blocks.x + x / block);
            const std::size_t from = cells.number({x, y, z});
            min[to] = std::min(min[to], cells.min[from]);
            max[to] = std::max(max[to], cells.max[from]);
          }
      EXPECT_EQ(b.min, min) << block;
      EXPECT_EQ(b.max, max) << block;
    }
  }
}

TEST(BlockBounds, OfASizeThatIsNoPowerOfTwoUpTo256AreRefused) {
  const CellBounds cells = bounds_of(smooth_coefficients({2, 2, 2}));
  for (int block : {-4, 0, 3, 12, 512}) {
    try {
      block_bounds(cells, block);
      FAIL() << block;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()),
                "--block: found " + std::to_string(block) + ", expected a power of two from 1 to 256");
    }
  }
}

}  // namespace
}  // namespace quincunx

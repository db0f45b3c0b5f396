// One bit per cell: may it hold something to be seen?
#include <tbb/parallel_reduce.h>
#include <tbb/blocked_range.h>

#include <bit>
#include <cstring>
#include <functional>

#include "accel/classification.h"
#include "accel/range_query.h"

namespace quincunx {
namespace {

constexpr std::int64_t kBrick = 4;
constexpr std::size_t kFewWindows = 8;  // up to here a vectorised comparison with each beats looking up tables

/// The same as Thresholds::touches of `n` intervals: mask[x] = 1 where interval x touches a range, else 0.
void touching_windows(const Thresholds& thresholds, const std::uint16_t* min, const std::uint16_t* max, std::int64_t n, std::uint8_t* mask) {
  std::memset(mask, 0, std::size_t(n));
  for (const auto [highest_min, lowest_max] : thresholds.windows()) {
    for (std::int64_t x = 0; x < n; ++x) mask[x] |= std::uint8_t((min[x] <= highest_min) & (max[x] >= lowest_max));
    // A range of all values there are: only here an empty interval, 65535 to 0, would count.
    if (highest_min == 65535 && lowest_max == 0)
      for (std::int64_t x = 0; x < n; ++x) mask[x] &= std::uint8_t(min[x] <= max[x]);
  }
}

/// The lowest bits of 4 bytes as 4 bits. Byte k's bit moves from 8k to 24 + k, and no two products meet.
std::uint64_t pack(const std::uint8_t* mask) {
  std::uint32_t bytes;
  std::memcpy(&bytes, mask, sizeof bytes);
  if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap32(bytes);
  return bytes * 0x01020408u >> 24 & 0xFu;
}

/// Asks `mark(min, max, n, mask)` for the marks of row after row of cells.
template <class Mark>
CellOccupancy marked_cells(const CellBounds& bounds, const Mark& mark) {
  CellOccupancy o;
  o.bricks = (bounds.cells + (kBrick - 1)) / kBrick;
  o.words.resize(std::size_t(o.bricks.x * o.bricks.y * o.bricks.z));

  using Rows = tbb::blocked_range<std::int64_t>;
  o.active_cells = tbb::parallel_reduce(
      Rows(0, o.bricks.y * o.bricks.z, 16), std::size_t(0),
      [&](const Rows& rows, std::size_t active) {
        std::vector<std::uint8_t> mask(std::size_t(o.bricks.x * kBrick));  // past the last cell it stays 0
        for (std::int64_t row = rows.begin(); row != rows.end(); ++row) {
          std::uint64_t* words = o.words.data() + row * o.bricks.x;
          for (std::int64_t yz = 0; yz < kBrick * kBrick; ++yz) {
            const std::int64_t y = row % o.bricks.y * kBrick + yz % kBrick, z = row / o.bricks.y * kBrick + yz / kBrick;
            if (y >= bounds.cells.y || z >= bounds.cells.z) continue;
            const std::size_t first = bounds.number({0, y, z});
            mark(bounds.min.data() + first, bounds.max.data() + first, bounds.cells.x, mask.data());
            for (std::int64_t x = 0; x < o.bricks.x; ++x) words[x] |= pack(mask.data() + x * kBrick) << (4 * yz);
          }
          for (std::int64_t x = 0; x < o.bricks.x; ++x) active += std::size_t(std::popcount(words[x]));
        }
        return active;
      },
      std::plus<>());
  return o;
}

}  // namespace

CellOccupancy occupancy(const CellBounds& bounds, std::span<const ValueRange> ranges, RangeQueryKind query) {
  const Thresholds thresholds(bounds, ranges);
  if (query == RangeQueryKind::intervals && thresholds.windows().size() <= kFewWindows)
    return marked_cells(bounds, [&](const std::uint16_t* min, const std::uint16_t* max, std::int64_t n, std::uint8_t* mask) {
      touching_windows(thresholds, min, max, n, mask);
    });
  return with_range_test(query, thresholds, [&](const auto& touches) {
    return marked_cells(bounds, [&](const std::uint16_t* min, const std::uint16_t* max, std::int64_t n, std::uint8_t* mask) {
      for (std::int64_t x = 0; x < n; ++x) mask[x] = touches(min[x], max[x]);
    });
  });
}

}  // namespace quincunx

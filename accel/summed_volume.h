// Counts of active blocks in any box of blocks.
//
// F. C. Crow, "Summed-area tables for texture mapping", SIGGRAPH 1984, doi:10.1145/964965.808600, in three dimensions.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/block_box.h"
#include "accel/classification.h"

namespace quincunx {

/// The table holds for each corner (x,y,z), 0 <= x <= blocks.x and so on, the number of active blocks b < (x,y,z) on every
/// axis. Built in parallel.
class SummedVolume {
 public:
  /// Throws InputError where there are 2^32 blocks or more.
  explicit SummedVolume(const Classification& blocks);

  const glm::ivec3& blocks() const { return blocks_; }
  /// Active blocks of `box`, which lies inside the blocks (asserted). Eight lookups.
  std::uint32_t count(const BlockBox& box) const;
  bool empty(const BlockBox& box) const { return count(box) == 0; }
  bool full(const BlockBox& box) const { return count(box) == std::uint64_t(box.volume()); }
  /// The smallest box with all active blocks of `box`; an empty box (low = high) where there are none.
  BlockBox trimmed(const BlockBox& box) const;

 private:
  std::uint32_t at(int x, int y, int z) const;

  glm::ivec3 blocks_{0};
  std::vector<std::uint32_t> sums_;  ///< (blocks + 1)^3, x fastest
};

}  // namespace quincunx

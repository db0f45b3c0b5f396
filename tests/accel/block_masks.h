// Blocks to cluster and to build trees over.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "accel/classification.h"
#include "accel/thresholds.h"

namespace quincunx {

/// A classification whose active blocks are those where active(b) holds.
Classification make_mask(const glm::ivec3& blocks, const std::function<bool(const glm::ivec3&)>& active);
/// All of them active.
Classification filled_mask(const glm::ivec3& blocks);

bool is_active(const Classification& blocks, const glm::ivec3& b);

/// For structures that ask for the blocks alone.
inline const Thresholds kNoThresholds{CellBounds{}, {}};

struct BlockMask {
  std::string name;
  Classification blocks;
};

/// Shells, solids, strands, planes and noise on extents that no power of two divides and on rows longer than one and two words of
/// 64 bits, one block in each corner, none, all, and rows of blocks.
std::vector<BlockMask> block_masks();

}  // namespace quincunx

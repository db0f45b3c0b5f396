#include "render/volume_bounds.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

#include "lattice/error.h"
#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

constexpr int kMostBlock = 256;

}  // namespace

VolumeBounds::VolumeBounds(CellBounds cells) : scale_(cells), cells_(std::move(cells)) {}

VolumeBounds::VolumeBounds(const ValueScale& scale, BlockBounds finest) : scale_(scale), finest_(finest.block) {
  blocks_.emplace(finest_, std::move(finest));
}

const BlockBounds& VolumeBounds::blocks(int block, double& made_ms) {
  if (block < finest_ || block > kMostBlock || !std::has_single_bit(unsigned(block)))
    throw InputError(fmt::format("--block: found {}, expected a power of two from {} to {}", block, finest_, kMostBlock));
  const auto known = blocks_.find(block);
  if (known != blocks_.end()) return known->second;
  const Stopwatch watch;
  const BlockBounds& made = blocks_.emplace(block, cells_ ? block_bounds(*cells_, block) : coarser(blocks_.at(finest_), block)).first->second;
  made_ms += watch.ms();
  return made;
}

}  // namespace quincunx

#include "accel/grid.h"

#include "lattice/stopwatch.h"

namespace quincunx {

void Grid::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  level_ = blocks.level;
  ++version_;
  report_ = {.leaves = blocks.active_blocks, .build_ms = watch.ms()};
}

std::vector<StructureBuffer> Grid::buffers() const {
  return {{"gridLevel", TexelFormat::r8, std::as_bytes(std::span(level_)), version_}};
}

}  // namespace quincunx

#include "accel/segments.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

/// What a node has of blocks inside the volume, as bits.
constexpr std::uint8_t kEmpty = 1, kActive = 2, kMixed = kEmpty | kActive;

/// Nodes of 2^level blocks' edge.
struct Level {
  glm::i64vec3 size{0};
  std::vector<std::uint8_t> holds;  ///< x fastest

  std::uint8_t at(std::int64_t x, std::int64_t y, std::int64_t z) const { return holds[std::size_t((z * size.y + y) * size.x + x)]; }
};

/// Calls row(y, z) for all rows of `size`, in parallel.
template <class Row>
void for_rows(const glm::i64vec3& size, Row row) {
  tbb::parallel_for(std::int64_t(0), size.y * size.z, [&](std::int64_t n) { row(n % size.y, n / size.y); });
}

Level coarser(const Level& finer) {
  Level level{.size = (finer.size + std::int64_t(1)) / std::int64_t(2), .holds = {}};
  level.holds.resize(std::size_t(level.size.x * level.size.y * level.size.z));
  for_rows(level.size, [&](std::int64_t y, std::int64_t z) {
    for (std::int64_t k = 2 * z; k < std::min(2 * z + 2, finer.size.z); ++k)
      for (std::int64_t j = 2 * y; j < std::min(2 * y + 2, finer.size.y); ++j)
        for (std::int64_t i = 0; i < finer.size.x; ++i) level.holds[std::size_t((z * level.size.y + y) * level.size.x + i / 2)] |= finer.at(i, j, k);
  });
  return level;
}

/// The blocks, and coarser levels up to a single node.
std::vector<Level> pyramid(const Classification& blocks) {
  std::vector<Level> levels(1, {.size = blocks.blocks, .holds = std::vector<std::uint8_t>(blocks.level.size())});
  std::ranges::transform(blocks.level, levels[0].holds.begin(), [](std::uint8_t level) { return level == Classification::active ? kActive : kEmpty; });
  while (levels.back().size != glm::i64vec3(1)) levels.push_back(coarser(levels.back()));
  return levels;
}

/// Counts the octree: the root, and the children of mixed nodes.
void count_nodes(const std::vector<Level>& levels, StructureReport& report) {
  report.leaves = report.nodes = 0;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const Level& level = levels[l];
    const auto exists = [&](std::int64_t x, std::int64_t y, std::int64_t z) { return l + 1 == levels.size() || levels[l + 1].at(x / 2, y / 2, z / 2) == kMixed; };
    std::uint64_t nodes = 0;
    for (std::int64_t z = 0; z < level.size.z; ++z)
      for (std::int64_t y = 0; y < level.size.y; ++y)
        for (std::int64_t x = 0; x < level.size.x; ++x) {
          if (!exists(x, y, z)) continue;
          ++nodes;
          report.leaves += level.at(x, y, z) == kActive;
        }
    if (nodes > 0) report.depth = std::max(report.depth, int(levels.size() - l));
    report.nodes += nodes;
  }
}

}  // namespace

std::vector<std::uint8_t> occupancy_leaves(const Classification& blocks, StructureReport& report) {
  const std::vector<Level> levels = pyramid(blocks);
  std::vector<std::uint8_t> leaves(blocks.level.size());
  for_rows(blocks.blocks, [&](std::int64_t y, std::int64_t z) {
    for (std::int64_t x = 0; x < blocks.blocks.x; ++x) {
      std::size_t l = 0;
      while (l + 1 < levels.size() && levels[l + 1].at(x >> (l + 1), y >> (l + 1), z >> (l + 1)) != kMixed) ++l;
      const bool active = levels[0].at(x, y, z) == kActive;
      leaves[std::size_t((z * blocks.blocks.y + y) * blocks.blocks.x + x)] = std::uint8_t(2 * l + (active ? 1 : 0));
    }
  });
  report.depth = 0;
  count_nodes(levels, report);
  return leaves;
}

void Segments::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  leaf_ = occupancy_leaves(blocks, report_);
  ++version_;
  report_.build_ms = watch.ms();
}

std::vector<StructureBuffer> Segments::buffers() const { return {{"blockLeaf", TexelFormat::r8, std::as_bytes(std::span(leaf_)), version_}}; }

}  // namespace quincunx

#include "accel/segments.h"

#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

/// Active nodes below mixed ones, and an active top.
std::uint64_t count_leaves(const std::vector<std::uint8_t>& nodes, glm::i64vec3 size) {
  std::uint64_t leaves = nodes.back() == Segments::full ? 1 : 0;
  for (std::size_t offset = 0; size != glm::i64vec3(1);) {
    const glm::i64vec3 coarser = (size + std::int64_t(1)) / std::int64_t(2);
    const std::size_t above = offset + std::size_t(size.x * size.y * size.z);
    for (std::int64_t z = 0; z < size.z; ++z)
      for (std::int64_t y = 0; y < size.y; ++y)
        for (std::int64_t x = 0; x < size.x; ++x) {
          if (nodes[offset + std::size_t((z * size.y + y) * size.x + x)] != Segments::full) continue;
          leaves += nodes[above + std::size_t((z / 2 * coarser.y + y / 2) * coarser.x + x / 2)] == Segments::mixed;
        }
    offset = above;
    size = coarser;
  }
  return leaves;
}

}  // namespace

void Segments::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  constexpr std::uint8_t unknown = 255;
  nodes_.resize(blocks.level.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) nodes_[n] = blocks.level[n] == Classification::active ? full : empty;
  top_ = add_levels(nodes_, blocks.blocks, unknown, [](std::uint8_t a, std::uint8_t b) { return a == unknown || a == b ? b : std::uint8_t(mixed); });
  report_ = {.leaves = count_leaves(nodes_, blocks.blocks), .nodes = nodes_.size(), .depth = top_.level + 1, .build_ms = watch.ms()};
  ++version_;
}

std::vector<StructureBuffer> Segments::buffers() const {
  return {{"segmentNodes", TexelFormat::r8, std::as_bytes(std::span(nodes_)), version_}};
}

}  // namespace quincunx

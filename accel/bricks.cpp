#include "accel/bricks.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr int kLeastEdge = 4, kMostEdge = 256;
constexpr std::int64_t kMostNumber = std::numeric_limits<std::int32_t>::max();

/// The number within its slot, laid out without end, of the first coefficient of `brick` as seen from (0; 0,0,0).
std::int64_t reach(const BrickLayout& layout, const glm::ivec3& brick) {
  const glm::i64vec3 first = layout.first_index(brick), strides(1, layout.strides().x, layout.strides().y);
  return first.x * strides.x + first.y * strides.y + first.z * strides.z;
}

}  // namespace

BrickLayout::BrickLayout(LatticeKind lattice_, const Extents& extents_, int apron_, int edge_, Storage storage_)
    : lattice(lattice_), extents(extents_), apron(apron_), edge(edge_), storage(storage_) {
  if (edge < kLeastEdge || edge > kMostEdge || !std::has_single_bit(unsigned(edge)))
    throw InputError(fmt::format("--brick: found {}, expected a power of two from {} to {}", edge, kLeastEdge, kMostEdge));
  const glm::i64vec3 n = (cell_count(lattice, extents) + std::int64_t(edge - 1)) / std::int64_t(edge);
  if (n.x > kMostBricks || n.y > kMostBricks / n.x || n.z > kMostBricks / n.x / n.y)
    throw InputError(fmt::format("--brick: found {}, which cuts the volume into {} x {} x {} bricks, expected at most 2^27 of them", edge,
                                 n.x, n.y, n.z));
  bricks = glm::ivec3(n);
  samples = edge / lattice_step(lattice) + 1 + 2 * apron;
  if (reach(*this, bricks - 1) + slot_floats() > kMostNumber)
    throw InputError(fmt::format("--brick: found {}, too large for a volume of {} x {} x {} samples, expected smaller ones", edge,
                                 extents.x, extents.y, extents.z));
}

std::int32_t BrickLayout::origin(const glm::ivec3& brick, int slot) const {
  const std::int64_t origin = slot * slot_floats() - reach(*this, brick);
  assert(origin <= kMostNumber && origin >= -kMostNumber);
  return std::int32_t(origin);
}

int BrickLayout::slots(std::uint64_t pool_bytes) const {
  const std::int64_t most = kMostNumber / slot_floats();
  const std::int64_t slots = std::int64_t(std::min(pool_bytes / slot_bytes(), std::uint64_t(count())));
  if (slots < 1)
    throw InputError(fmt::format("--pool: found {} bytes, expected at least {} bytes, one brick of {} cells with its border", pool_bytes,
                                 slot_bytes(), edge));
  if (slots > most)
    throw InputError(fmt::format("--pool: found {} bytes, expected at most {} bytes with bricks of {} cells", pool_bytes,
                                 std::uint64_t(most) * slot_bytes(), edge));
  return int(slots);
}

glm::ivec3 eye_brick(const BrickLayout& layout, const glm::dvec3& eye) {
  const glm::dvec3 last(cell_count(layout.lattice, layout.extents) - std::int64_t(1));
  return layout.brick_of_cell(glm::ivec3(glm::clamp(glm::floor(eye), glm::dvec3(0.0), last)));
}

void sort_front_to_back(const BrickLayout& layout, const glm::dvec3& eye, std::vector<std::int32_t>& bricks) {
  const glm::ivec3 from = eye_brick(layout, eye);
  std::vector<std::pair<std::int32_t, std::int32_t>> order;
  order.reserve(bricks.size());
  for (const std::int32_t number : bricks) {
    const glm::ivec3 away = glm::abs(layout.brick(number) - from);
    order.emplace_back(away.x + away.y + away.z, number);
  }
  std::sort(order.begin(), order.end());
  std::transform(order.begin(), order.end(), bricks.begin(), [](const auto& o) { return o.second; });
}

std::vector<std::uint8_t> active_bricks(const BrickLayout& layout, const Classification& blocks) {
  std::vector<std::uint8_t> active(std::size_t(layout.count()), 0);
  const glm::i64vec3 last = blocks.blocks - std::int64_t(1);
  tbb::parallel_for(std::int64_t(0), layout.count(), [&](std::int64_t number) {
    const glm::i64vec3 cell = glm::i64vec3(layout.brick(std::int32_t(number))) * std::int64_t(layout.edge);
    const glm::i64vec3 low = cell / std::int64_t(blocks.block);
    const glm::i64vec3 high = glm::min((cell + std::int64_t(layout.edge - 1)) / std::int64_t(blocks.block), last);
    for (std::int64_t z = low.z; z <= high.z; ++z)
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        const std::uint8_t* row = blocks.level.data() + (z * blocks.blocks.y + y) * blocks.blocks.x;
        if (std::find(row + low.x, row + high.x + 1, Classification::active) == row + high.x + 1) continue;
        active[std::size_t(number)] = 1;
        return;
      }
  });
  return active;
}

}  // namespace quincunx

#include <algorithm>
#include <cassert>

#include "accel/cluster.h"
#include "accel/summed_volume.h"

namespace quincunx {
namespace {

/// Blocks that are in a cube already.
class Taken {
 public:
  explicit Taken(const glm::ivec3& blocks) : blocks_(blocks) {
    taken_.resize(std::size_t(blocks.x) * std::size_t(blocks.y) * std::size_t(blocks.z));
  }

  bool any(const BlockBox& box) const {
    for (int z = box.low.z; z < box.high.z; ++z)
      for (int y = box.low.y; y < box.high.y; ++y) {
        const std::uint8_t* row = taken_.data() + number(box.low.x, y, z);
        if (std::find(row, row + box.size().x, 1) != row + box.size().x) return true;
      }
    return false;
  }
  void take(const BlockBox& box) {
    for (int z = box.low.z; z < box.high.z; ++z)
      for (int y = box.low.y; y < box.high.y; ++y) std::fill_n(taken_.data() + number(box.low.x, y, z), box.size().x, std::uint8_t(1));
  }

 private:
  std::size_t number(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(blocks_.y) + std::size_t(y)) * std::size_t(blocks_.x) + std::size_t(x);
  }

  glm::ivec3 blocks_;
  std::vector<std::uint8_t> taken_;
};

}  // namespace

std::vector<BlockBox> cluster_cubes(const Classification& blocks, int max_cluster) {
  assert(max_cluster >= 1);
  const SummedVolume sums(blocks);
  const glm::ivec3 size = sums.blocks();
  Taken taken(size);
  std::vector<BlockBox> cubes;
  for (int edge = std::min({max_cluster, size.x, size.y, size.z}); edge >= 1; --edge)
    for (int z = 0; z + edge <= size.z; ++z)
      for (int y = 0; y + edge <= size.y; ++y)
        for (int x = 0; x + edge <= size.x; ++x) {
          const BlockBox cube{{x, y, z}, glm::ivec3(x, y, z) + edge};
          if (!sums.full(cube) || taken.any(cube)) continue;
          taken.take(cube);
          cubes.push_back(cube);
        }
  return cubes;
}

std::vector<BlockBox> single_blocks(const Classification& blocks) {
  std::vector<BlockBox> boxes;
  boxes.reserve(blocks.active_blocks);
  const glm::ivec3 size(blocks.blocks);
  const std::uint8_t* level = blocks.level.data();
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x, ++level)
        if (*level == Classification::active) boxes.push_back({{x, y, z}, {x + 1, y + 1, z + 1}});
  return boxes;
}

}  // namespace quincunx

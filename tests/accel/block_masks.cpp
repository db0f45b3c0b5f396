#include "block_masks.h"

#include <cmath>
#include <random>

namespace quincunx {

Classification make_mask(const glm::ivec3& blocks, const std::function<bool(const glm::ivec3&)>& active) {
  Classification c;
  c.blocks = glm::i64vec3(blocks);
  for (int z = 0; z < blocks.z; ++z)
    for (int y = 0; y < blocks.y; ++y)
      for (int x = 0; x < blocks.x; ++x) {
        const bool set = active({x, y, z});
        c.level.push_back(set ? Classification::active : std::uint8_t((x + y + z) % 3));
        c.active_blocks += set;
      }
  return c;
}

Classification filled_mask(const glm::ivec3& blocks) {
  return make_mask(blocks, [](const glm::ivec3&) { return true; });
}

bool is_active(const Classification& blocks, const glm::ivec3& b) {
  return blocks.level[std::size_t((b.z * blocks.blocks.y + b.y) * blocks.blocks.x + b.x)] == Classification::active;
}

std::vector<BlockMask> block_masks() {
  std::vector<BlockMask> masks;
  const auto add = [&](std::string name, const glm::ivec3& blocks, const std::function<bool(const glm::ivec3&)>& active) {
    masks.push_back({std::move(name), make_mask(blocks, active)});
  };
  const auto from_middle = [](const glm::ivec3& b, const glm::ivec3& blocks) {
    return glm::length(glm::dvec3(b) + 0.5 - 0.5 * glm::dvec3(blocks));
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto noise = [&](double part) { return [&uniform, &random, part](const glm::ivec3&) { return uniform(random) < part; }; };

  const glm::ivec3 cube(37, 35, 33), wide(70, 21, 19), wider(135, 9, 11);
  for (const glm::ivec3& blocks : {cube, wide, wider}) {
    const std::string size = " in " + std::to_string(blocks.x) + " x " + std::to_string(blocks.y) + " x " + std::to_string(blocks.z);
    add("a shell" + size, blocks, [&](const glm::ivec3& b) { return std::abs(from_middle(b, blocks) - 14.5) < 1.0; });
    add("a ball" + size, blocks, [&](const glm::ivec3& b) { return from_middle(b, blocks) < 13.0; });
    add("strands" + size, blocks, [](const glm::ivec3& b) {
      return std::hypot(b.x % 16 - 8 - 3 * std::sin(0.3 * b.z), b.y % 16 - 8 - 3 * std::cos(0.3 * b.z)) < 1.5;
    });
    add("a slanted plane" + size, blocks, [](const glm::ivec3& b) { return std::abs(b.x + 2 * b.y - b.z - 40) < 3; });
    add("sparse noise" + size, blocks, noise(0.1));
    add("even noise" + size, blocks, noise(0.5));
    add("dense noise" + size, blocks, noise(0.97));
  }
  add("a checkerboard", {9, 8, 7}, [](const glm::ivec3& b) { return (b.x + b.y + b.z) % 2 == 0; });
  const glm::ivec3 corners(6, 5, 4);
  for (int corner = 0; corner < 8; ++corner)
    add("corner " + std::to_string(corner), corners, [&](const glm::ivec3& b) {
      return b == glm::ivec3(corner & 1 ? 5 : 0, corner & 2 ? 4 : 0, corner & 4 ? 3 : 0);
    });
  const glm::ivec3 small[] = {{5, 3, 7}, {1, 1, 1}, {1, 1, 40}, {40, 1, 1}, {1, 90, 1}, {64, 2, 2}, {65, 3, 1}, {128, 1, 3}};
  for (const glm::ivec3& blocks : small) {
    const std::string size = std::to_string(blocks.x) + " x " + std::to_string(blocks.y) + " x " + std::to_string(blocks.z);
    masks.push_back({"all of " + size, filled_mask(blocks)});
    add("none of " + size, blocks, [](const glm::ivec3&) { return false; });
    add("half of " + size, blocks, noise(0.5));
  }
  return masks;
}

}  // namespace quincunx

#include "accel/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace quincunx {
namespace {

using Mask = std::function<bool(const glm::ivec3&)>;

Classification classification_of(const glm::i64vec3& blocks, const Mask& active) {
  Classification c;
  c.blocks = blocks;
  for (int z = 0; z < blocks.z; ++z)
    for (int y = 0; y < blocks.y; ++y)
      for (int x = 0; x < blocks.x; ++x) {
        const bool is = active({x, y, z});
        c.level.push_back(is ? Classification::active : 0);
        c.active_blocks += is;
      }
  return c;
}

/// By looking at every pair of blocks.
std::vector<std::uint8_t> brute_force(const Classification& c) {
  std::vector<glm::ivec3> active, all;
  for (int z = 0; z < c.blocks.z; ++z)
    for (int y = 0; y < c.blocks.y; ++y)
      for (int x = 0; x < c.blocks.x; ++x) {
        if (c.level[all.size()] == Classification::active) active.emplace_back(x, y, z);
        all.emplace_back(x, y, z);
      }
  std::vector<std::uint8_t> distances;
  for (const glm::ivec3& b : all) {
    int least = 255;
    for (const glm::ivec3& a : active) {
      const glm::ivec3 d = glm::abs(a - b);
      least = std::min(least, std::max(d.x, std::max(d.y, d.z)));
    }
    distances.push_back(std::uint8_t(least));
  }
  return distances;
}

TEST(Distance, IsThatOfTheNearestActiveBlockForRandomBlocksOfEveryDensity) {
  std::mt19937 random(5);
  for (const double density : {0.0, 0.001, 0.01, 0.1, 0.6, 1.0})
    for (const glm::i64vec3& size : {glm::i64vec3(9, 7, 11), {1, 1, 23}, {16, 1, 5}, {1, 1, 1}, {13, 17, 2}}) {
      std::bernoulli_distribution active(density);
      const Classification c = classification_of(size, [&](const glm::ivec3&) { return active(random); });
      EXPECT_EQ(chebyshev_distances(c), brute_force(c)) << density << ", " << size.x << " x " << size.y << " x " << size.z;
    }
}

TEST(Distance, OfASingleBlockIsExactToEveryCorner) {
  for (const glm::ivec3& at : {glm::ivec3(0), {14, 9, 11}, {0, 9, 0}, {7, 5, 6}}) {
    const Classification c = classification_of({15, 10, 12}, [&](const glm::ivec3& b) { return b == at; });
    EXPECT_EQ(chebyshev_distances(c), brute_force(c));
  }
}

TEST(Distance, Above255IsGivenAs255) {
  const Classification c = classification_of({600, 1, 1}, [](const glm::ivec3& b) { return b.x == 0; });
  const std::vector<std::uint8_t> distances = chebyshev_distances(c);
  EXPECT_EQ(distances[254], 254);
  for (std::size_t x = 255; x < 600; ++x) ASSERT_EQ(distances[x], 255) << x;
}

}  // namespace
}  // namespace quincunx

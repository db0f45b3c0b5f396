// Boxes of blocks.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace quincunx {

/// The blocks b with low <= b < high on every axis, in blocks of the classification they were made from.
struct BlockBox {
  glm::ivec3 low{0}, high{0};

  bool operator==(const BlockBox&) const = default;
  glm::ivec3 size() const { return high - low; }
  std::int64_t volume() const { return std::int64_t(high.x - low.x) * (high.y - low.y) * (high.z - low.z); }
};

}  // namespace quincunx

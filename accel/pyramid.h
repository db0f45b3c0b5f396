// A complete pyramid over blocks: level 0 are the blocks, each level above halves their number on every axis (rounding up), the last one is a single node.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace quincunx {

/// Where kernels find its top (shaders/pyramid.glsl).
struct PyramidTop {
  int level = 0;           ///< number of the last level
  std::size_t offset = 0;  ///< its place among the nodes
};

/// Appends to `nodes`, which are the blocks, x fastest, at least one, the levels above them one after another: each node is what join(a, b)
/// makes of `nothing` and its children, at most eight, in any order.
template <class Node, class Join>
PyramidTop add_levels(std::vector<Node>& nodes, const glm::i64vec3& blocks, const Node& nothing, const Join& join) {
  PyramidTop top;
  for (glm::i64vec3 finer = blocks, size; finer != glm::i64vec3(1); finer = size) {
    size = (finer + std::int64_t(1)) / std::int64_t(2);
    const std::size_t below = top.offset;
    top = {top.level + 1, nodes.size()};
    nodes.resize(top.offset + std::size_t(size.x * size.y * size.z));
    tbb::parallel_for(std::int64_t(0), size.y * size.z, [&](std::int64_t row) {
      const std::int64_t y = row % size.y, z = row / size.y;
      for (std::int64_t x = 0; x < size.x; ++x) {
        Node node = nothing;
        for (std::int64_t k = 2 * z; k < std::min(2 * z + 2, finer.z); ++k)
          for (std::int64_t j = 2 * y; j < std::min(2 * y + 2, finer.y); ++j)
            for (std::int64_t i = 2 * x; i < std::min(2 * x + 2, finer.x); ++i)
              node = join(node, nodes[below + std::size_t((k * finer.y + j) * finer.x + i)]);
        nodes[top.offset + std::size_t(row * size.x + x)] = node;
      }
    });
  }
  return top;
}

}  // namespace quincunx

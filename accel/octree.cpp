#include "accel/octree.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

/// A level of `size` nodes from the level below, of `finer` ones.
template <class Node>
void reduce(const Node* below, const glm::i64vec3& finer, Node* nodes, const glm::i64vec3& size) {
  tbb::parallel_for(std::int64_t(0), size.y * size.z, [&](std::int64_t row) {
    const std::int64_t y = row % size.y, z = row / size.y;
    for (std::int64_t x = 0; x < size.x; ++x) {
      Node node{65535, 0};
      for (std::int64_t k = 2 * z; k < std::min(2 * z + 2, finer.z); ++k)
        for (std::int64_t j = 2 * y; j < std::min(2 * y + 2, finer.y); ++j)
          for (std::int64_t i = 2 * x; i < std::min(2 * x + 2, finer.x); ++i) {
            const Node& child = below[(k * finer.y + j) * finer.x + i];
            node = {std::min(node.min, child.min), std::max(node.max, child.max)};
          }
      nodes[row * size.x + x] = node;
    }
  });
}

}  // namespace

void Octree::prepare(const BlockBounds& blocks) {
  const Stopwatch watch;
  std::vector<glm::i64vec3> sizes{blocks.blocks};
  std::size_t count = blocks.min.size();
  while (sizes.back() != glm::i64vec3(1)) {
    sizes.push_back((sizes.back() + std::int64_t(1)) / std::int64_t(2));
    count += std::size_t(sizes.back().x * sizes.back().y * sizes.back().z);
  }
  nodes_.resize(count);
  for (std::size_t n = 0; n < blocks.min.size(); ++n) nodes_[n] = {blocks.min[n], blocks.max[n]};
  last_level_ = int(sizes.size()) - 1;
  last_offset_ = 0;
  for (int level = 1; level <= last_level_; ++level) {
    const glm::i64vec3& finer = sizes[std::size_t(level) - 1];
    Node* below = nodes_.data() + last_offset_;
    last_offset_ += std::size_t(finer.x * finer.y * finer.z);
    reduce(below, finer, nodes_.data() + last_offset_, sizes[std::size_t(level)]);
  }
  ++bounds_version_;
  report_ = {.nodes = count, .depth = last_level_ + 1, .build_ms = watch.ms()};
}

void Octree::build(const Classification&, const Thresholds& thresholds) {
  windows_ = kernel_windows(thresholds);
  ++windows_version_;
}

std::vector<StructureBuffer> Octree::buffers() const {
  return {{"octreeBounds", TexelFormat::rg16, std::as_bytes(std::span(nodes_)), bounds_version_},
          {"windows", TexelFormat::rg32, std::as_bytes(std::span(windows_)), windows_version_}};
}

glm::ivec4 Octree::parameters() const { return {last_level_, int(last_offset_), int(windows_.size()), 0}; }

}  // namespace quincunx

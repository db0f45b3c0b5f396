#include "accel/octree.h"

#include <algorithm>

#include "accel/pyramid.h"
#include "lattice/stopwatch.h"

namespace quincunx {

void Octree::prepare(const BlockBounds& blocks) {
  const Stopwatch watch;
  nodes_.resize(blocks.min.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) nodes_[n] = {blocks.min[n], blocks.max[n]};
  top_ = add_levels(nodes_, blocks.blocks, Node{65535, 0}, [](const Node& a, const Node& b) { return Node{std::min(a.min, b.min), std::max(a.max, b.max)}; });
  ++bounds_version_;
  report_ = {.nodes = nodes_.size(), .depth = top_.level + 1, .build_ms = watch.ms()};
}

void Octree::build(const Classification&, const Thresholds& thresholds) {
  windows_ = kernel_windows(thresholds);
  ++windows_version_;
}

std::vector<StructureBuffer> Octree::buffers() const {
  return {{"octreeBounds", TexelFormat::rg16, std::as_bytes(std::span(nodes_)), bounds_version_},
          {"windows", TexelFormat::rg32, std::as_bytes(std::span(windows_)), windows_version_}};
}

glm::ivec4 Octree::parameters() const { return {top_.level, int(top_.offset), int(windows_.size()), 0}; }

}  // namespace quincunx

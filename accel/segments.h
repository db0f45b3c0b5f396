// Occupancy geometry: the segments of each ray that may matter, listed before it is cast.
//
// M. Hadwiger, A. K. Al-Awami, J. Beyer, M. Agus, H. Pfister, "SparseLeap: Efficient Empty Space Skipping for Large-Scale Volume Rendering", IEEE
// Transactions on Visualization and Computer Graphics 24(1), 2018, doi:10.1109/TVCG.2017.2744238.
//
// Departures. There a node of the octree has the class of most of it, children of another class are boxes of their own, and rasterising the boxes in visibility
// order appends to linked lists of segments; here nodes are of one class throughout, and a compute shader that goes from leaf to leaf writes
// lists of a fixed capacity, the last segment of a full one reaching to the end of its ray. As there, neighbours of one class are one segment.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/structure.h"

namespace quincunx {

/// The octree over the classified blocks, down to nodes that are active or empty throughout, written down by the leaf of each block. One buffer:
///
///   name       element                                                              count
///   blockLeaf  uint8: 2 l + a of the leaf that holds the block, a cube of 2^l       blocks.x * blocks.y * blocks.z, x fastest
///              blocks at multiples of it; a: 1 where they are active, else 0
///
/// and what its pass writes (shaders/ray_segments.glsl).
class Segments final : public SkippingStructure {
 public:
  struct Config {
    int capacity = 16;  ///< of a ray's list
  };
  explicit Segments(const Config& config) : config_(config) {}

  std::string_view name() const override { return "segments"; }
  std::string_view shader() const override { return "skip_segments.glsl"; }
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  std::vector<StructureBuffer> buffers() const override;
  std::optional<SegmentPass> segment_pass() const override { return SegmentPass{"segments_octree.glsl", config_.capacity}; }
  /// x: capacity.
  glm::ivec4 parameters() const override { return {config_.capacity, 0, 0, 0}; }
  /// Leaves: active ones.
  StructureReport report() const override { return report_; }

 private:
  Config config_;
  std::vector<std::uint8_t> leaf_;
  StructureReport report_;
  std::uint64_t version_ = 0;
};

/// The octree's leaves by block, as Segments keeps them; `report` gets leaves, nodes and depth.
std::vector<std::uint8_t> occupancy_leaves(const Classification& blocks, StructureReport& report);

}  // namespace quincunx

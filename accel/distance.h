// A map of distances to the nearest active block.
//
// L. Deakin, M. Knackstedt, "Efficient ray casting of volumetric images using distance maps for empty space skipping",
// Computational Visual Media 6, 2020, doi:10.1007/s41095-019-0155-y (Chebyshev distance, isotropic). The transform is that of A. Meijster,
// J. Roerdink, W. Hesselink, "A general algorithm for computing distance transforms in linear time", 2000,
// doi:10.1007/0-306-47025-X_36, for the chessboard metric.
#pragma once

#include "accel/structure.h"

namespace quincunx {

/// Chebyshev distances in blocks, up to 255. One buffer:
///
///   name           element                                                  count
///   blockDistance  uint8: 0 for an active block; d: every block closer      blocks.x * blocks.y * blocks.z, x fastest
///                  than d on every axis is empty
class Distance final : public SkippingStructure {
 public:
  std::string_view name() const override { return "distance"; }
  std::string_view shader() const override { return "skip_distance.glsl"; }
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  std::vector<StructureBuffer> buffers() const override;
  StructureReport report() const override { return report_; }

 private:
  std::vector<std::uint8_t> distance_;
  StructureReport report_;
  std::uint64_t version_ = 0;
};

/// Distances of all blocks, x fastest; computed in parallel.
std::vector<std::uint8_t> chebyshev_distances(const Classification& blocks);

}  // namespace quincunx

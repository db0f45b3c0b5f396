// A uniform grid of blocks, walked block by block.
#pragma once

#include "accel/structure.h"

namespace quincunx {

/// The blocks as they are classified. One buffer:
///
///   name       element                                             count
///   gridLevel  uint8: Classification::active, or the block's level blocks.x * blocks.y * blocks.z, x fastest
class Grid final : public SkippingStructure {
 public:
  std::string_view name() const override { return "grid"; }
  std::string_view shader() const override { return "skip_grid.glsl"; }
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  std::vector<StructureBuffer> buffers() const override;
  StructureReport report() const override { return report_; }

 private:
  std::vector<std::uint8_t> level_;
  StructureReport report_;
  std::uint64_t version_ = 0;
};

}  // namespace quincunx

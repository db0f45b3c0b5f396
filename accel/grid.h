// A uniform grid of blocks, walked block by block.
#pragma once

#include "accel/structure.h"

namespace quincunx {

/// The blocks' levels as they are classified. One buffer:
///
///   name       element                                             count
///   gridLevel  uint8: Classification::active, or the block's level blocks.x * blocks.y * blocks.z, x fastest
class Grid final : public SkippingStructure {
 public:
  std::string_view name() const override { return "grid"; }
  std::string_view shader() const override { return "skip_grid.glsl"; }
  bool needs_classification() const override { return true; }
  void build(const Classification& classification) override;
  std::vector<StructureBuffer> buffers() const override;

 private:
  std::vector<std::uint8_t> level_;
};

}  // namespace quincunx

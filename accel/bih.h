// A bounding interval hierarchy over active blocks (accel/bih_build.h has the papers).
#pragma once

#include "accel/bih_build.h"
#include "accel/structure.h"

namespace quincunx {

/// On the device: the nodes of the hierarchy over the blocks' grid, planes whole blocks, one leaf a block. Children do not overlap, as blocks
/// do not, so that a walk meets the leaves in the order of the ray. A leaf holds its block instead
/// of a number, so that kernels know its box exactly:
///
///   offset  bits   what
///        0  0-1    3
///        0  2-15   0
///        0  16-31  x of the block
///        4  0-15   y
///        4  16-31  z
class BihSkipping final : public SkippingStructure {
 public:
  static constexpr int stack = 48;  ///< of the kernel: nodes with two children above a leaf, at most

  struct Config {
    int chunk_levels = 4;  ///< see BihConfig
  };
  BihSkipping() = default;
  explicit BihSkipping(const Config& config) : config_(config) {}

  std::string_view name() const override { return "bih"; }
  std::string_view shader() const override { return "skip_bih.glsl"; }
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  std::vector<StructureBuffer> buffers() const override;
  /// xyz: where the planes are counted from, in blocks. w: leaves.
  glm::ivec4 parameters() const override { return parameters_; }
  StructureReport report() const override { return report_; }

 private:
  Config config_;
  std::vector<BihNode> nodes_;  ///< at least one once built
  glm::ivec4 parameters_{0};
  StructureReport report_;
  std::uint64_t version_ = 0;
};

}  // namespace quincunx

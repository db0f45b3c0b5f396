// A hybrid grid: a shallow k-d tree with a uniform grid of blocks in each of its leaves.
//
// S. Zellmann, D. Meurer, U. Lang, "Hybrid Grids for Sparse Volume Rendering", IEEE Visualization 2019 (short papers),
// doi:10.1109/VISUAL.2019.8933631.
//
// Departures. The tree is that of accel/kdtree.h. The leaves' grids are parts of one over all blocks, as leaves are boxes of blocks: a tree that
// changes copies nothing. Minima and maxima are compared with the ranges of visible values themselves, exactly, not by a query over entries.
#pragma once

#include "accel/kernel_windows.h"
#include "accel/leaf_list.h"
#include "accel/structure.h"

namespace quincunx {

/// The leaves, as accel/leaf_list.h keeps them, in a buffer `boxes` (accel/box_tree.h), and
///
///   of  name          element                                            count
///   pc  hybridLevel   uint8: Classification::active, or another level    blocks.x * blocks.y * blocks.z, x fastest
///   mm  hybridBounds  2 x uint16: min, max (quantised like CellBounds)   the same
///       windows       KernelWindow                                       as kernel_windows returns them
///
/// In mm, what can be seen changes the leaves and the windows alone, and the windows alone where the same blocks stay active.
class Hybrid final : public SkippingStructure {
 public:
  struct Config {
    HybridGrid grid = HybridGrid::pc;
    double least_share = 0.1;  ///< no leaf is smaller than this part of the root's volume
  };
  explicit Hybrid(const Config& config) : config_(config) {}

  std::string_view name() const override { return "hybrid"; }
  std::string_view shader() const override;
  void prepare(const BlockBounds& blocks) override;
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  void compare(const Thresholds& thresholds) override;
  /// Sorts the leaves front to back.
  void arrange(const glm::dvec3& eye) override;
  std::vector<StructureBuffer> buffers() const override;
  /// x: leaves, z: windows of mm.
  glm::ivec4 parameters() const override;
  /// Leaves are the active blocks; nodes and depth those of the tree over them.
  StructureReport report() const override { return report_; }

 private:
  struct Bounds {
    std::uint16_t min, max;
  };

  Config config_;
  LeafList list_;
  std::vector<std::uint8_t> level_;    ///< of pc
  std::vector<Bounds> bounds_;         ///< of mm
  std::vector<KernelWindow> windows_;  ///< of mm
  double prepare_ms_ = 0.0;
  StructureReport report_;
  std::uint64_t list_version_ = 0, grid_version_ = 0, windows_version_ = 0;
};

}  // namespace quincunx

// A min/max octree.
//
// M. Kim, "Quartic box-spline reconstruction on the BCC lattice", IEEE Transactions on Visualization and Computer Graphics 19(2),
// 2013, doi:10.1109/TVCG.2012.130, whose isosurfaces skip by an octree of minima and maxima. There they come from samples or
// spline coefficients; here from the Bernstein-Bezier net (accel/bounds.h).
#pragma once

#include "accel/kernel_windows.h"
#include "accel/structure.h"

namespace quincunx {

/// A complete pyramid: level 0 are the blocks, each level above halves their number on every axis (rounding up), the last one is
/// a single node. The kernel compares nodes with the isovalues itself, so that a change of isovalue builds nothing.
/// Two buffers:
///
///   name           element                                            count
///   octreeBounds   2 x uint16: min, max (quantised like CellBounds)   the levels one after another, each x fastest
///   windows        KernelWindow                                       as kernel_windows returns them
class Octree final : public SkippingStructure {
 public:
  std::string_view name() const override { return "octree"; }
  std::string_view shader() const override { return "skip_octree.glsl"; }
  Needs needs() const override { return Needs::bounds; }
  void prepare(const BlockBounds& blocks) override;
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  std::vector<StructureBuffer> buffers() const override;
  /// x: number of the last level, y: its place in octreeBounds, z: windows.
  glm::ivec4 parameters() const override;
  StructureReport report() const override { return report_; }

 private:
  struct Node {
    std::uint16_t min, max;
  };
  std::vector<Node> nodes_;
  std::vector<KernelWindow> windows_;
  int last_level_ = 0;
  std::size_t last_offset_ = 0;
  StructureReport report_;  ///< leaves stay 0: which they are is decided in the kernel
  std::uint64_t bounds_version_ = 0, windows_version_ = 0;
};

}  // namespace quincunx

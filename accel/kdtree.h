// A k-d tree over the summed volume of the blocks.
//
// V. Vidal, X. Mei, P. Decaudin, "Simple empty-space removal for interactive volume rendering", Journal of Graphics Tools 13(2), 2008,
// doi:10.1080/2151237X.2008.10129258; S. Zellmann, J. P. Schulze, U. Lang, "Rapid k-d tree construction for sparse volume data",
// Eurographics Symposium on Parallel Graphics and Visualization 2018, doi:10.2312/pgv.20181097.
//
// Departures. The authors' programs cut the longest axis alone, at every fourth or eighth voxel, where more than a twentieth
// of the box is saved, and split every box larger than a tenth of the root, so that leaves may be smaller; here every block plane of
// every axis is tried, any saving counts, and the tenth holds for the leaves. Deep trees also halve boxes that no plane makes smaller.
#pragma once

#include "accel/leaf_list.h"
#include "accel/structure.h"

namespace quincunx {

class KdTree final : public SkippingStructure {
 public:
  struct Config {
    KdDepth depth = KdDepth::deep;
    double least_share = 0.1;  ///< of KdDepth::shallow: no leaf is smaller than this part of the root's volume
    int leaf_cells = 2048;     ///< of KdDepth::deep: boxes of this volume or less, in cells, are not split: 8^3 samples of a BCC volume
  };
  explicit KdTree(const Config& config) : config_(config) {}

  std::string_view name() const override { return "kdtree"; }
  /// A list of leaves in the order of the eye's rays (shallow), or a tree that each ray walks (deep).
  std::string_view shader() const override;
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  /// Sorts the leaves of a shallow tree front to back.
  void arrange(const glm::dvec3& eye) override;
  std::vector<StructureBuffer> buffers() const override;
  /// x: leaves.
  glm::ivec4 parameters() const override;
  StructureReport report() const override { return report_; }

 private:
  Config config_;
  BoxTree tree_;   ///< of KdDepth::deep
  LeafList list_;  ///< of KdDepth::shallow
  StructureReport report_;
  std::uint64_t version_ = 0;
};

}  // namespace quincunx

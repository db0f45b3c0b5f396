// A bounding volume hierarchy over active blocks or clusters of them.
//
// D. Ganter, M. Manzke, "An analysis of region clustered BVH volume rendering on GPU", Computer Graphics Forum 38(8), 2019,
// doi:10.1111/cgf.13756. Built by Embree's binned SAH builder (I. Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007, doi:10.1109/RT.2007.4342588) instead of on the device.
#pragma once

#include "accel/box_tree.h"
#include "accel/structure.h"

namespace quincunx {

class Bvh final : public SkippingStructure {
 public:
  struct Config {
    Clustering clustering = Clustering::none;
    int max_cluster = 16;  ///< of Clustering::cubes
  };
  explicit Bvh(const Config& config) : config_(config) {}

  std::string_view name() const override { return "bvh"; }
  std::string_view shader() const override { return "skip_box_tree.glsl"; }
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  std::vector<StructureBuffer> buffers() const override { return {buffer_of(tree_, version_)}; }
  glm::ivec4 parameters() const override;
  StructureReport report() const override { return report_; }

 private:
  Config config_;
  BoxTree tree_;
  StructureReport report_;
  std::uint64_t version_ = 0;
};

}  // namespace quincunx

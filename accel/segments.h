// Lists of segments: for each ray of a picture the stretches of it that are in active blocks, found before the ray is cast.
//
// M. Hadwiger, A. K. Al-Awami, J. Beyer, M. Agus, H. Pfister, "SparseLeap: efficient empty space skipping for large-scale volume rendering", IEEE
// Transactions on Visualization and Computer Graphics 24(1), 2018, doi:10.1109/TVCG.2017.2744238.
//
// Departures. They rasterise the faces of an octree's boxes of one class each in the order of visibility, and link what each pixel gets to lists; here each
// ray walks the octree itself, in a pass of compute. Their nodes take the class that most of what is in them has; here a node is of a class only
// where all of it is. Lists are of a fixed length; the last segment of one that is full reaches to the end of the ray.
#pragma once

#include "accel/pyramid.h"
#include "accel/structure.h"

namespace quincunx {

/// A pyramid over the blocks (accel/pyramid.h), in one buffer,
///
///   name           element                                             count
///   segmentNodes   uint8: 0 all empty, 1 all active, 2 some of both    the levels one after another, each x fastest
///
/// and, of each ray, most_segments pairs of numbers that shaders/make_segments.glsl writes.
class Segments final : public SkippingStructure {
 public:
  struct Config {
    int most_segments = 16;  ///< of a ray, 1..256
  };
  explicit Segments(const Config& config) : config_(config) {}

  enum State : std::uint8_t { empty = 0, full = 1, mixed = 2 };

  std::string_view name() const override { return "segments"; }
  std::string_view shader() const override { return "skip_segments.glsl"; }
  std::optional<RayLists> ray_lists() const override { return RayLists{"make_segments.glsl", "SegmentLists", "segments", config_.most_segments}; }
  void build(const Classification& blocks, const Thresholds& thresholds) override;
  std::vector<StructureBuffer> buffers() const override;
  /// xy: as PyramidTop, z: most_segments.
  glm::ivec4 parameters() const override { return {top_.level, int(top_.offset), config_.most_segments, 0}; }
  /// Leaves are the largest nodes that are active as a whole.
  StructureReport report() const override { return report_; }

 private:
  Config config_;
  std::vector<std::uint8_t> nodes_;
  PyramidTop top_;
  StructureReport report_;
  std::uint64_t version_ = 0;
};

}  // namespace quincunx

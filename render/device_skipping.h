// The skipping structure of a renderer on the device: built from bounds when something it depends on has changed.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "accel/choose_skip.h"
#include "accel/classification.h"
#include "accel/structure.h"
#include "gpu/gpu.h"
#include "render/renderer.h"
#include "render/volume_bounds.h"
#include "shaders/shared/trace_parameters.h"

namespace quincunx {

class DeviceSkipping {
 public:
  explicit DeviceSkipping(gpu::Device& device) : device_(device) {}

  /// `wanted` with nothing left open, for a volume's bounds (the same at every call) and the values that can be seen, of a volume alone where
  /// `volume`, and why.
  SkipChoice choose(const SkipConfig& wanted, VolumeBounds& bounds, std::span<const ValueRange> ranges, bool volume, RenderStats& stats);

  /// Builds and uploads what `config`, in which nothing is open, needs for `ranges` and rays from `eye` (lattice coordinates), keeping what
  /// still holds from the call before: the structure while the set of active blocks stays, their classification while the ranges do.
  /// `bounds` are the same at every call; null only for a structure that needs none. Adds to the times of `stats`.
  void prepare(const SkipConfig& config, VolumeBounds* bounds, std::span<const ValueRange> ranges, const glm::dvec3& eye, RenderStats& stats);

  /// The buffers, by their names in the kernels.
  gpu::Resources resources() const;
  /// Sets `blocks`, `bricks` and `structure`.
  void set_parameters(TraceParameters& parameters) const;
  /// Of the structure that was prepared last, if it has one.
  std::optional<SegmentPass> segment_pass() const { return structure_->segment_pass(); }
  /// Tells what the last prepare made: counts and bytes.
  void describe(RenderStats& stats) const;

 private:
  using Needs = SkippingStructure::Needs;
  struct Uploaded {
    std::string name;
    std::uint64_t version = 0;
    gpu::Buffer buffer;
  };

  bool same_kind(const SkipConfig& config) const;
  /// Forgets what was classified for other ranges, or by another query.
  void set_ranges(std::span<const ValueRange> ranges, RangeQueryKind query);
  const Classification& classified(VolumeBounds& bounds, int block, RenderStats& stats);
  void prepare_structure(const SkipConfig& config, VolumeBounds& bounds, RenderStats& stats);
  void classify_cells(const CellBounds& cells, RenderStats& stats);
  /// False where nothing had changed.
  bool upload(RenderStats& stats);

  gpu::Device& device_;
  SkipConfig config_;
  std::vector<ValueRange> ranges_;
  RangeQueryKind query_ = RangeQueryKind::intervals;  ///< by which ranges_ are looked for
  std::map<int, Classification> classified_;  ///< for ranges_, by block size
  std::optional<CellOccupancy> occupancy_;    ///< for ranges_
  std::unique_ptr<SkippingStructure> structure_;
  bool built_for_ranges_ = false;          ///< structure_ is what ranges_ asks for
  std::optional<Classification> built_;    ///< what structure_ was built from, where it needs one
  const BlockBounds* blocks_ = nullptr;    ///< those of structure_; null where it needs none
  std::vector<Uploaded> buffers_;
  gpu::Buffer occupancy_buffer_;
  bool occupancy_uploaded_ = false;
};

}  // namespace quincunx

// The skipping structure of a renderer on the device: built from bounds when something it depends on has changed.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "accel/classification.h"
#include "accel/structure.h"
#include "gpu/gpu.h"
#include "render/renderer.h"
#include "shaders/shared/trace_parameters.h"

namespace quincunx {

class DeviceSkipping {
 public:
  explicit DeviceSkipping(gpu::Device& device) : device_(device) {}

  /// Builds and uploads what `config` needs for `isovalues` (ascending) and rays from `eye` (lattice coordinates), keeping what
  /// still holds from the call before: block bounds while the block size stays, the structure while the set of active blocks does.
  /// `cells` are the same at every call; null only for a structure that needs none. Adds to the times of `stats`.
  void prepare(const SkipConfig& config, const CellBounds* cells, std::span<const double> isovalues, const glm::dvec3& eye,
               RenderStats& stats);

  /// The buffers, by their names in the kernels.
  gpu::Resources resources() const;
  /// Sets `blocks`, `bricks` and `structure`.
  void set_parameters(TraceParameters& parameters) const;
  /// Tells what there is: counts and bytes. `cells` and `isovalues` as in prepare.
  void describe(const CellBounds* cells, std::span<const double> isovalues, RenderStats& stats) const;

 private:
  using Needs = SkippingStructure::Needs;
  struct Uploaded {
    std::string name;
    std::uint64_t version = 0;
    gpu::Buffer buffer;
  };

  bool same_kind(const SkipConfig& config) const;
  void prepare_structure(const SkipConfig& config, const CellBounds* cells, std::span<const double> isovalues, RenderStats& stats);
  void classify_cells(const CellBounds& cells, std::span<const double> isovalues, RenderStats& stats);
  /// False where nothing had changed.
  bool upload(RenderStats& stats);

  gpu::Device& device_;
  SkipConfig config_;
  std::vector<double> isovalues_, cell_isovalues_;  ///< that the structure, the occupancy bits are for
  std::unique_ptr<SkippingStructure> structure_;
  std::optional<BlockBounds> blocks_;
  std::optional<Classification> classification_;
  std::optional<CellOccupancy> occupancy_;
  std::vector<Uploaded> buffers_;
  gpu::Buffer occupancy_buffer_;
  bool occupancy_uploaded_ = false;
};

}  // namespace quincunx

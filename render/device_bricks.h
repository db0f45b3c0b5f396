// The brick pool of a renderer on the device: its buffers, and rounds of rays that wait for bricks.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "gpu/gpu.h"
#include "render/brick_pool.h"
#include "render/coefficient_texels.h"
#include "render/renderer.h"
#include "shaders/shared/trace_parameters.h"

namespace quincunx {

class DeviceBricks {
 public:
  /// A pool of as many slots as fit `pool_bytes`; `texel_elements`: the most of one texel buffer. Where the layout's storage is not float32, each brick
  /// has a unit of its own, the storage_unit of its slot. Throws as BrickPool and CoefficientTexels do.
  DeviceBricks(gpu::Device& device, const BrickLayout& layout, std::shared_ptr<const BrickSource> source, std::uint64_t pool_bytes,
               std::uint64_t texel_elements);

  const BrickLayout& layout() const { return pool_.layout(); }
  const TexelLayout& texels() const { return texels_.layout(); }
  /// The buffers, by their names in the kernels.
  gpu::Resources resources() const;
  /// Sets `strides` and `pages`.
  void set_parameters(TraceParameters& parameters) const;
  /// Before each dispatch: no ray waits.
  void clear_requests();
  /// After it: makes resident what rays wait for, the bricks nearest to `eye` (lattice coordinates) where there is no room for all. False where none waits.
  bool serve(const glm::dvec3& eye, const Progress& progress);

  void describe(RenderStats& stats) const;

 private:
  /// Whether bricks have units of their own.
  bool packed() const { return texels_.format().storage != Storage::float32; }
  /// Puts a brick into its slot of the device, its unit into units_.
  void upload_slot(std::int32_t brick, std::int64_t first, std::span<const float> slot);
  /// Tells the device the entries of bricks first <= n < first + count.
  void upload_entries(std::size_t first, std::size_t count);

  gpu::Device& device_;
  BrickPool pool_;
  CoefficientTexels texels_;
  gpu::Buffer page_table_, requests_, unit_buffer_;
  std::vector<glm::vec2> units_;  ///< by brick: offset and scale of a resident one
  std::vector<std::byte> packed_;  ///< of one slot
  std::vector<std::uint32_t> requested_;  ///< by brick, as the kernels write it
  double load_ms_ = 0.0;
  std::uint64_t rounds_ = 0;
};

}  // namespace quincunx

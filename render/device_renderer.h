// The renderer on a Vulkan device.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "accel/classification.h"
#include "accel/structure.h"
#include "gpu/gpu.h"
#include "render/kernel_cache.h"
#include "render/renderer.h"
#include "render/trace_frame.h"

namespace quincunx {

/// Limits of the device that tests lower, to reach what only large volumes and pictures reach; 0 means the device's own.
struct DeviceLimits {
  std::uint64_t texel_elements = 0;  ///< of one coefficient buffer
  std::uint64_t frame_bytes = 0;     ///< of one buffer of the picture
};

class DeviceRenderer final : public Renderer {
 public:
  DeviceRenderer(std::shared_ptr<KernelCache> kernels, const Volume& volume, const Config& config, const DeviceLimits& limits = {});

  Frame render(const Request& request, RenderStats& stats, const Progress& progress = {}) override;
  std::vector<Feature> explain(const Request& request) override;

  KernelVariant variant(const Request& request) const;

 private:
  struct CoefficientLayout {
    int buffers = 1, shift = 0;
  };
  /// What the picture is written to: rows that fit the device's limits at a time.
  struct Band {
    int rows = 0;
    gpu::Buffer color, hit, cost, rays;
  };

  void prepare_coefficients(RenderStats& stats, const Progress& progress);
  void prepare_bounds(const Request& request, RenderStats& stats, const Progress& progress);
  void prepare_structure(const Request& request, const std::vector<double>& isovalues, RenderStats& stats);
  void upload_isosurfaces(const std::vector<Isosurface>& isosurfaces);
  Band make_band(const Scene& scene, bool cost);
  gpu::Resources resources(const gpu::Pipeline& pipeline, const Band& band) const;
  double trace(const Kernels& kernels, const Scene& scene, Band& band, Frame* frame, const Progress& progress);
  TraceParameters make_parameters(const Scene& scene);
  /// Runs both kernels on no pixel: drivers compile at the first use, which no frame's time shall hold.
  void finish_compiling(const Kernels& kernels, const Scene& scene, const Band& band);
  double trace_band(const Kernels& kernels, const Band& band, int width, int rows);
  void read_band(const Band& band, int row, int rows, Frame& frame);
  std::uint64_t count_evaluations(Request request, const Progress& progress);
  static Frame empty_frame(const Scene& scene);
  void describe(const Band& band, RenderStats& stats) const;
  CoefficientLayout coefficient_layout() const;
  bool uses_cells(const Request& request) const;

  std::shared_ptr<KernelCache> kernels_;
  gpu::Device& device_;  ///< that of kernels_
  Config config_;
  DeviceLimits limits_;
  std::unique_ptr<Spline> spline_;
  Volume volume_;  ///< until the coefficients are made
  std::optional<Coefficients<float>> coefficients_;
  std::vector<gpu::Buffer> coefficient_buffers_;

  std::optional<CellBounds> cells_;
  std::optional<BlockBounds> blocks_;
  /// What the structure on the device was built for.
  struct Built {
    std::string structure;
    int block = 0;
    bool cell_test = false;
    std::vector<double> isovalues;
    bool operator==(const Built&) const = default;
  };
  Built built_;
  std::unique_ptr<SkippingStructure> structure_;
  std::uint64_t block_count_ = 0, active_blocks_ = 0, active_cells_ = 0;
  glm::i64vec3 block_extents_{0}, brick_extents_{0};
  std::vector<std::pair<std::string, gpu::Buffer>> structure_buffers_;
  gpu::Buffer occupancy_, isosurfaces_, parameters_;
};

}  // namespace quincunx

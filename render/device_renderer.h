// The renderer on a Vulkan device.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "accel/void_cells.h"
#include "gpu/gpu.h"
#include "render/coefficient_texels.h"
#include "render/device_bricks.h"
#include "render/device_skipping.h"
#include "render/kernel_cache.h"
#include "render/renderer.h"
#include "render/volume_bounds.h"
#include "render/trace_frame.h"

namespace quincunx {

/// Limits of the device that tests lower, to reach what only large volumes and pictures reach; 0 means the device's own.
struct DeviceLimits {
  std::uint64_t texel_elements = 0;  ///< of one coefficient buffer
  std::uint64_t frame_bytes = 0;     ///< of one buffer of the picture
  bool no_float64 = false;           ///< as of a device without 64-bit floats
  bool no_small_texels = false;      ///< as of a device without texel buffers of 16 and 8 bits
};

class DeviceRenderer final : public Renderer {
 public:
  DeviceRenderer(std::shared_ptr<KernelCache> kernels, const Volume& volume, const Config& config, const DeviceLimits& limits = {});
  /// For samples that are read brick by brick; config.pool_bytes is set. `what` names them in errors.
  DeviceRenderer(std::shared_ptr<KernelCache> kernels, std::shared_ptr<const SampleSource> source, const std::string& what, const Config& config,
                 const DeviceLimits& limits = {});

  Frame render(const Request& request, RenderStats& stats, const Progress& progress = {}) override;
  std::vector<Feature> explain(const Request& request) override;

  KernelVariant variant(const Request& request) const;

 private:
  /// What the picture is written to: rows that fit the device's limits at a time.
  struct Band {
    int rows = 0;
    gpu::Buffer color, hit, cost, rays, parked;
    gpu::Buffer segments, segment_counts;  ///< of a structure's SegmentPass
  };
  /// What tracing a picture or band took, and making the lists of segments of it.
  struct Traced {
    double ms = 0.0, segments_ms = 0.0;
    std::uint64_t steps = 0, listed = 0, full = 0;

    void operator+=(const Traced& t) { ms += t.ms, segments_ms += t.segments_ms, steps += t.steps, listed += t.listed, full += t.full; }
  };

  /// What coefficients are on the device.
  CoefficientFormat format() const { return {.precision = config_.precision, .storage = config_.storage}; }
  /// Throws DeviceError where the device cannot compute in config_.precision.
  void check_precision() const;
  /// Throws DeviceError where the device cannot read config_.storage.
  void check_device_storage() const;
  /// Makes the samples finite, as config_.nan says, and finds the void cells.
  void prepare_samples(RenderStats& stats);
  void prepare_coefficients(RenderStats& stats, const Progress& progress);
  /// Prefilters: makes coefficients_ what kernels decode, in single precision, and gives the bytes of what they read.
  std::vector<std::byte> make_coefficients(const Progress& progress);
  void prepare_bounds(const Request& request, RenderStats& stats, const Progress& progress);
  /// Where nothing is skipped: throws InputError for samples of the source that are not finite, as prepare_bounds does.
  void check_samples(const Progress& progress);
  /// The unit of the source's coefficients: a pass over its samples where they are floats.
  ValueUnit source_unit(const Progress& progress);
  /// What of the scene can be seen, in the unit of the coefficients and their bounds.
  std::vector<ValueRange> seen_numbers(const Scene& scene) const;
  /// How to skip, with nothing left open, and why (empty where nothing was).
  SkipChoice complete(const Request& request, RenderStats& stats, const Progress& progress);
  void upload_isosurfaces(const std::vector<Isosurface>& isosurfaces);
  /// Makes the table anew where anything that it depends on has changed.
  void upload_transfer_table(const Scene& scene, RenderStats& stats);
  /// Bytes of a ray's list of segments; 0 where there are none.
  std::uint64_t segment_bytes() const;
  Band make_band(const Scene& scene, bool cost);
  gpu::Resources resources(const gpu::Pipeline& pipeline, const Band& band) const;
  Traced trace(const Kernels& kernels, const Scene& scene, Band& band, Frame* frame, const Progress& progress);
  TraceParameters make_parameters(const Scene& scene);
  /// Runs the kernels on no pixel: drivers compile at the first use, which no frame's time shall hold.
  void finish_compiling(const Kernels& kernels, const Scene& scene, const Band& band);
  std::uint32_t rays_per_lane() const;
  Traced list_segments(const KernelPass& pass, const Band& band, std::uint32_t groups_x, std::uint32_t groups_y);
  Traced trace_band(const Kernels& kernels, const Band& band, const Scene& scene, int rows, const Progress& progress);
  void read_band(const Band& band, int row, int rows, Frame& frame);
  void count_costs(Request request, RenderStats& stats, const Progress& progress);
  static Frame empty_frame(const Scene& scene);
  void add_frame(const Traced& traced, RenderStats& stats) const;
  void describe(const Band& band, RenderStats& stats) const;
  /// Throws InputError for more cells than kernels can number.
  void check_cells() const;
  TexelLayout coefficient_layout() const;
  void check_bricks(const Scene& scene) const;
  void check_intersect(const Scene& scene) const;
  glm::dvec3 lattice_eye(const Scene& scene) const;

  std::shared_ptr<KernelCache> kernels_;
  gpu::Device& device_;  ///< that of kernels_
  Config config_;
  DeviceLimits limits_;
  std::unique_ptr<Spline> spline_;
  Volume volume_;  ///< until the coefficients are made
  std::optional<VoidCells> voids_;
  std::optional<Coefficients<float>> coefficients_;  ///< rounded, for bounds, where kernels read doubles; without data where there is a source
  double value_rounding_ = 0.0;  ///< of kernels that compute in doubles (render/tracer.h)
  CoefficientTexels texels_;
  std::shared_ptr<const SampleSource> source_;  ///< of bricks; null where all coefficients are on the device
  std::string what_;                            ///< the source's name
  std::optional<SampleRange> source_range_;     ///< of the source's samples, once they were looked at and found finite
  std::optional<DeviceBricks> bricks_;

  std::optional<VolumeBounds> bounds_;
  std::optional<DeviceSkipping> skipping_;
  gpu::Buffer isosurfaces_, transfer_table_, parameters_, void_buffer_;
  std::optional<DirectVolume> tabled_;  ///< what transfer_table_ was made for
};

}  // namespace quincunx

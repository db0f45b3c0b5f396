// The renderer of voxels: `--render bih`.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "accel/voxels.h"
#include "gpu/gpu.h"
#include "render/renderer.h"
#include "shaders/shared/trace_parameters.h"
#include "shaders/shared/voxel_parameters.h"

namespace quincunx {

/// What one kernel of voxels is for.
struct VoxelVariant {
  bool spheres = false, lit = false, modulated = false, cost = false;

  auto operator<=>(const VoxelVariant&) const = default;
};

gpu::KernelSource voxel_kernel(const VoxelVariant& variant);

/// Voxels in a bounding interval hierarchy on a Vulkan device. Renders what Scene::volume says, without steps: every voxel that a ray meets is one sample.
/// Z as render_reference_voxels has it.
class VoxelRenderer final : public Renderer {
 public:
  struct Config {
    int leaf_size = 1;        ///< voxels of a leaf of the tree, at most
    bool validation = false;  ///< of the device: any message throws
    std::uint64_t frame_bytes = 0;  ///< of one buffer of the picture, which tests lower; 0: the device's limit
  };
  VoxelRenderer(std::shared_ptr<gpu::Device> device, Voxels voxels, const Config& config);

  Frame render(const Request& request, RenderStats& stats, const Progress& progress = {}) override;
  std::vector<Feature> explain(const Request& request) override;

 private:
  /// What the picture is written to: rows that fit the device's limits at a time.
  struct Band {
    int rows = 0;
    gpu::Buffer color, hit, cost;
  };

  /// Builds the tree and uploads all but what depends on the scene; drops the voxels themselves.
  void build(RenderStats& stats);
  VoxelVariant variant(const Scene& scene) const;
  const gpu::Pipeline& pipeline(const VoxelVariant& variant, double& compile_ms);
  void upload_table(const DirectVolume& volume, RenderStats& stats);
  void upload_parameters(const Scene& scene);
  /// Of the picture; parameters_ becomes their buffer, to which they are still to be uploaded.
  TraceParameters make_parameters(const Scene& scene);
  /// Runs the kernel over no pixel: drivers compile the last of it when it first runs.
  void finish_compiling(const gpu::Pipeline& pipeline, const Scene& scene, const Band& band);
  Band make_band(const Scene& scene) const;
  /// One frame, milliseconds; copied to `frame` where there is one.
  double trace(const gpu::Pipeline& pipeline, const Scene& scene, const Band& band, Frame* frame, const Progress& progress);
  gpu::Resources resources(const gpu::Pipeline& pipeline, const Band& band) const;
  void describe(const Band& band, RenderStats& stats) const;

  std::shared_ptr<gpu::Device> device_;
  Voxels voxels_;  ///< once the tree is built without data and places
  Config config_;
  VoxelStats stats_;
  bool built_ = false;
  VoxelParameters numbers_{};
  gpu::Buffer nodes_, data_, places_, table_, parameters_, voxel_parameters_;
  std::optional<TransferFunction> tabled_;
  std::map<VoxelVariant, gpu::Pipeline> pipelines_;
};

/// The renderer of `voxels` on the device that make_renderer would take: "cpu" is render_reference_voxels.
std::unique_ptr<Renderer> make_voxel_renderer(const std::string& device, Voxels voxels, const VoxelRenderer::Config& config);

}  // namespace quincunx

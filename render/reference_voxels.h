// Voxels in double precision: the truth that shaders/voxels.comp is compared with.
#pragma once

#include "accel/voxels.h"
#include "lattice/progress.h"
#include "render/renderer.h"

namespace quincunx {

/// The picture of `voxels` through scene.volume, which is set; the scene has no surfaces. Every ray looks for all voxels that it meets, in boxes about runs
/// of them and in no tree, and passes them in the order in which it enters them, of two entered at once the one first that it leaves first; each hides as
/// much as its length along the ray is worth. Voxels that overlap are passed one after another, each whole.
/// Z is where the ray leaves the voxel by which half of what is behind is hidden.
Frame render_reference_voxels(const Voxels& voxels, const Scene& scene, const Progress& progress = {});

/// The same behind the renderer's interface: `--render bih --device cpu`.
class ReferenceVoxelRenderer final : public Renderer {
 public:
  explicit ReferenceVoxelRenderer(Voxels voxels) : voxels_(std::move(voxels)) {}
  Frame render(const Request& request, RenderStats& stats, const Progress& progress = {}) override;
  std::vector<Feature> explain(const Request&) override { return {}; }

 private:
  Voxels voxels_;
};

}  // namespace quincunx

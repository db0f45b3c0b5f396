#include "render/reference_renderer.h"

#include <algorithm>
#include <cmath>

#include "lattice/error.h"
#include "lattice/stopwatch.h"

namespace quincunx {
ReferenceRenderer::ReferenceRenderer(const Volume& volume, const Config& config)
    : config_(config), spline_(make_spline(config.spline, volume.lattice)), volume_(volume) {}

void ReferenceRenderer::prepare_coefficients(const Progress& progress) {
  voids_ = make_finite(volume_, *spline_, config_.nan);
  if (config_.storage == Storage::float32) {
    coefficients_ = spline_->coefficients(volume_, config_.prefilter, progress);
  } else {
    coefficients_ = values_of(stored_coefficients(*spline_, volume_, config_.prefilter, config_.storage, progress));
  }
  volume_.samples = {};
}

Frame ReferenceRenderer::render(const Request& request, RenderStats& stats, const Progress& progress) {
  check_scene(request.scene);
  if (request.scene.stub_sampling)
    throw InputError("--stub-sampling: found --device cpu, expected a Vulkan device: the reference walks no structure");
  stats = RenderStats{};
  stats.device = "cpu (double precision)";
  stats.precision = Precision::float64;
  stats.storage = config_.storage == Storage::float32 ? "float64" : storage_name(config_.storage);
  if (!coefficients_) {
    const Stopwatch watch;
    prepare_coefficients(progress);
    stats.prefilter_ms = watch.ms();
  }
  const bool skips = request.skip.structure != "none";
  if (skips && !cells_) {
    const Stopwatch watch;
    cells_ = cell_bounds(*spline_, narrowed(*coefficients_), progress);
    stats.bounds_ms = watch.ms();
  }

  Scene scene = request.scene;
  scene.cost = scene.cost || request.count_costs;
  Frame frame;
  for (int i = 0; i < request.repeat; ++i) {
    const Stopwatch watch;
    frame = render_reference(*spline_, *coefficients_, scene, skips ? &*cells_ : nullptr, progress, &voids_);
    stats.trace_ms.push_back(watch.ms());
  }
  const CostSums sums = cost_sums(frame);
  stats.evaluations = sums.evaluations;
  stats.steps = sums.steps;
  stats.intervals = sums.intervals;
  stats.skip = request.skip;
  stats.void_cells = voids_.count;
  if (!request.scene.cost) frame.cost.clear();
  stats.rays = std::uint64_t(frame.width) * frame.height;
  stats.hits = count_hits(frame);
  return frame;
}

}  // namespace quincunx

#include "bench/hit_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace quincunx {

void HitComparison::add(const Truth& truth, const Scene& scene, const Frame& frame, const Frame& reference) {
  assert(scene.isosurfaces.size() == 1 && frame.depth.size() == reference.depth.size());
  const Truth::Rays rays = truth.rays(scene);
  // A hit on a ray that misses the domain is outside by rounding: it counts as a false one.
  std::vector<double> cells(frame.depth.size(), 1.0);
  std::vector<double> residuals(std::size_t(frame.height), 0.0);
  tbb::parallel_for(0, frame.height, [&](int j) {
    for (int i = 0; i < frame.width; ++i) {
      const std::size_t p = std::size_t(j) * std::size_t(frame.width) + std::size_t(i);
      const auto ray = rays.ray(i, j);
      if (!ray) continue;
      cells[p] = ray->scale;
      const double depth = frame.depth[p];
      if (std::isfinite(depth))
        residuals[std::size_t(j)] = std::max(residuals[std::size_t(j)], rays.residual(*ray, depth, scene.isosurfaces.front().isovalue));
    }
  });
  residual_max_ = std::max(residual_max_, *std::max_element(residuals.begin(), residuals.end()));
  frames_.add(frame, reference, [&](std::size_t p) { return cells[p]; });
}

HitErrors HitComparison::errors() const {
  HitErrors errors;
  static_cast<FrameErrors&>(errors) = frames_.errors();
  errors.residual_max = residual_max_;
  return errors;
}

}  // namespace quincunx

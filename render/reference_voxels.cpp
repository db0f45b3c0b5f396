#include "render/reference_voxels.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "lattice/stopwatch.h"
#include "render/ray.h"
#include "render/shading.h"
#include "render/voxel_table.h"

namespace quincunx {
namespace {

constexpr std::size_t kRun = 64;  // voxels of a run, and runs of a run of runs

/// A stretch of a ray, s in cells from its entry; none where exit <= entry.
struct Span {
  double entry = 0.0, exit = 0.0;
};

struct Met {
  Span span;
  std::size_t voxel;
};

Span box_span(const LatticeRay& ray, const VoxelBox& box) {
  Span span{0.0, ray.length};
  for (int a = 0; a < 3; ++a) {
    const double o = ray.origin[a], d = ray.direction[a];
    if (d == 0.0) {
      if (!(box.low[a] <= o && o < box.high[a])) return {};
      continue;
    }
    const double low = (box.low[a] - o) / d, high = (box.high[a] - o) / d;
    span.entry = std::max(span.entry, std::min(low, high));
    span.exit = std::min(span.exit, std::max(low, high));
  }
  return span;
}

VoxelBox join(const VoxelBox& a, const VoxelBox& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

/// The boxes about each kRun of `boxes`.
std::vector<VoxelBox> runs_of(const std::vector<VoxelBox>& boxes) {
  std::vector<VoxelBox> runs;
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    if (n % kRun == 0) runs.push_back(boxes[n]);
    runs.back() = join(runs.back(), boxes[n]);
  }
  return runs;
}

class VoxelPainter {
 public:
  VoxelPainter(const Voxels& voxels, const Scene& scene)
      : voxels_(voxels), scene_(scene), volume_(*scene.volume), frame_(camera_frame(scene.camera, scene.width, scene.height)),
        space_(ray_space(voxels.lattice, voxels.extents, voxels.world, scene.camera.eye)), half_(0.5 * glm::dvec3(domain_max(voxels.lattice, voxels.extents))) {
    for (std::size_t n = 0; n < voxels.size(); ++n) boxes_.push_back(voxels.box(n));
    runs_ = runs_of(boxes_);
    runs_of_runs_ = runs_of(runs_);
    const std::size_t pixels = std::size_t(scene.width) * scene.height;
    picture_.width = scene.width, picture_.height = scene.height;
    picture_.color.resize(4 * pixels);
    picture_.depth.resize(pixels, std::numeric_limits<float>::infinity());
    picture_.normal.resize(3 * pixels);
    if (scene.cost) picture_.cost.resize(3 * pixels);
  }

  void paint_row(int j) {
    for (int i = 0; i < scene_.width; ++i) paint_pixel(i, j);
  }
  Frame finish() { return std::move(picture_); }

 private:
  Span span_of(const LatticeRay& ray, std::size_t n) const {
    if (voxels_.shape == VoxelShape::cuboid) return box_span(ray, boxes_[n]);
    const glm::dvec3 to = centre_of(n) - ray.origin;
    const double nearest = glm::dot(to, ray.direction), radius = voxels_.spheres[n].radius;
    const glm::dvec3 off = to - nearest * ray.direction;
    const double chord = radius * radius - glm::dot(off, off);
    if (!(chord > 0.0)) return {};
    return {std::max(nearest - std::sqrt(chord), 0.0), std::min(nearest + std::sqrt(chord), ray.length)};
  }
  glm::dvec3 centre_of(std::size_t n) const {
    const SpherePlace& s = voxels_.spheres[n];
    return glm::dvec3(s.centre[0], s.centre[1], s.centre[2]) + half_;
  }

  /// All voxels that the ray meets, in order.
  std::vector<Met> meet(const LatticeRay& ray, CostSums& cost) const {
    const auto meets = [&](const VoxelBox& box) {
      ++cost.steps;
      const Span span = box_span(ray, box);
      return span.entry <= span.exit;
    };
    std::vector<Met> met;
    for (std::size_t rr = 0; rr < runs_of_runs_.size(); ++rr) {
      if (!meets(runs_of_runs_[rr])) continue;
      for (std::size_t r = rr * kRun; r < std::min((rr + 1) * kRun, runs_.size()); ++r) {
        if (!meets(runs_[r])) continue;
        for (std::size_t n = r * kRun; n < std::min((r + 1) * kRun, boxes_.size()); ++n) {
          ++cost.evaluations;
          const Span span = span_of(ray, n);
          if (span.entry < span.exit) met.push_back({span, n});
        }
      }
    }
    std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) {
      return std::tuple(a.span.entry, a.span.exit, a.voxel) < std::tuple(b.span.entry, b.span.exit, b.voxel);
    });
    return met;
  }

  /// What a voxel adds.
  void pass(const LatticeRay& ray, const glm::dvec3& direction, const Met& met, Composite& seen) const {
    const VoxelLook look = unpack(voxels_.data[met.voxel], voxels_.scale);
    const double value = voxels_.scale.density(look.density);
    double depth = voxel_extinction(volume_.function, value, voxels_.unit) * (met.span.exit - met.span.entry) * ray.scale;
    if (volume_.modulated()) depth *= std::clamp((look.magnitude - volume_.modulate_from) / (volume_.modulate_to - volume_.modulate_from), 0.0, 1.0);
    glm::dvec3 color = volume_.function.color(value);
    if (volume_.shade) color = headlight(color, scene_.ambient, facing_normal(normal(ray, met, look), direction), direction);
    seen.behind(color, -std::expm1(-depth));
  }
  glm::dvec3 normal(const LatticeRay& ray, const Met& met, const VoxelLook& look) const {
    if (voxels_.shape == VoxelShape::cuboid) return look.direction;
    return voxels_.world.axes * (ray.point(met.span.entry) - centre_of(met.voxel));
  }

  void paint_pixel(int i, int j) {
    const std::size_t pixel = std::size_t(j) * scene_.width + i;
    const glm::dvec3 direction = pixel_direction(frame_, scene_.width, scene_.height, i, j);
    Composite seen;
    CostSums cost;
    if (const auto ray = clip_ray(space_, direction)) {
      for (const Met& met : meet(*ray, cost)) {
        if (seen.transmittance <= volume_.termination) break;
        const bool half = seen.transmittance > 0.5;
        pass(*ray, direction, met, seen);
        ++cost.intervals;
        if (half && seen.transmittance <= 0.5) picture_.depth[pixel] = float(ray->distance(met.span.exit));
      }
    }
    const glm::dvec3 color = seen.color + seen.transmittance * scene_.background;
    for (int c = 0; c < 3; ++c) picture_.color[4 * pixel + c] = float(color[c]);
    picture_.color[4 * pixel + 3] = float(1.0 - seen.transmittance);
    if (!scene_.cost) return;
    picture_.cost[3 * pixel] = float(cost.evaluations);
    picture_.cost[3 * pixel + 1] = float(cost.steps);
    picture_.cost[3 * pixel + 2] = float(cost.intervals);
  }

  const Voxels& voxels_;
  const Scene& scene_;
  const DirectVolume& volume_;
  CameraFrame frame_;
  RaySpace space_;
  glm::dvec3 half_;
  std::vector<VoxelBox> boxes_, runs_, runs_of_runs_;
  Frame picture_;
};

}  // namespace

Frame render_reference_voxels(const Voxels& voxels, const Scene& scene, const Progress& progress) {
  assert(scene.volume && scene.isosurfaces.empty());
  check_scene(scene);
  VoxelPainter painter(voxels, scene);
  const int batch = std::max(16, 4 * tbb::this_task_arena::max_concurrency());
  for (int begin = 0; begin < scene.height; begin += batch) {
    report(progress, double(begin) / scene.height);
    tbb::parallel_for(begin, std::min(begin + batch, scene.height), [&](int row) { painter.paint_row(row); });
  }
  report(progress, 1.0);
  return painter.finish();
}

Frame ReferenceVoxelRenderer::render(const Request& request, RenderStats& stats, const Progress& progress) {
  stats = RenderStats{};
  stats.device = "cpu (double precision)";
  stats.precision = Precision::float64;
  stats.voxels = voxel_stats(voxels_);
  Scene scene = request.scene;
  scene.cost = scene.cost || request.count_costs;
  Frame frame;
  for (int i = 0; i < request.repeat; ++i) {
    const Stopwatch watch;
    frame = render_reference_voxels(voxels_, scene, progress);
    stats.trace_ms.push_back(watch.ms());
  }
  const CostSums sums = cost_sums(frame);
  stats.evaluations = sums.evaluations, stats.steps = sums.steps, stats.intervals = sums.intervals;
  if (!request.scene.cost) frame.cost.clear();
  stats.rays = std::uint64_t(frame.width) * frame.height;
  stats.hits = count_hits(frame);
  return frame;
}

}  // namespace quincunx

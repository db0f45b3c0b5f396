#include "render/reference.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "render/ray.h"
#include "render/reference_volume.h"
#include "render/shading.h"
#include "render/tracer.h"

namespace quincunx {
namespace {

constexpr int kTile = 16;

/// One picture in the making.
class Painter {
 public:
  Painter(const Spline& spline, const Coefficients<double>& coefficients, const Scene& scene, const CellBounds* cells, const VoidCells* voids)
      : spline_(spline),
        coefficients_(coefficients),
        scene_(scene),
        surfaces_(visible_surfaces(scene)),
        tracer_(spline, coefficients, isovalues_of(surfaces_), cells, {scene.intersect, scene.step}, voids),
        volume_(scene.volume ? std::optional<ReferenceVolume>(std::in_place, spline, coefficients, *scene.volume, scene.ambient, voids) : std::nullopt),
        frame_(camera_frame(scene.camera, scene.width, scene.height)),
        space_(ray_space(coefficients.lattice, coefficients.extents, coefficients.world, scene.camera.eye)) {
    const std::size_t pixels = std::size_t(scene.width) * scene.height;
    picture_.width = scene.width;
    picture_.height = scene.height;
    picture_.color.resize(4 * pixels);
    picture_.depth.resize(pixels, std::numeric_limits<float>::infinity());
    picture_.normal.resize(3 * pixels);
    if (scene.cost) picture_.cost.resize(3 * pixels);
  }

  int tiles() const { return tiles_x() * ((scene_.height + kTile - 1) / kTile); }

  void paint_tile(int tile) {
    Tracer::Workspace work;
    const int i0 = tile % tiles_x() * kTile, j0 = tile / tiles_x() * kTile;
    for (int j = j0; j < std::min(j0 + kTile, scene_.height); ++j)
      for (int i = i0; i < std::min(i0 + kTile, scene_.width); ++i) paint_pixel(i, j, work);
  }

  Frame finish() { return std::move(picture_); }

 private:
  int tiles_x() const { return (scene_.width + kTile - 1) / kTile; }

  void paint_pixel(int i, int j, Tracer::Workspace& work) {
    const std::size_t pixel = std::size_t(j) * scene_.width + i;
    const glm::dvec3 direction = pixel_direction(frame_, scene_.width, scene_.height, i, j);
    const auto ray = clip_ray(space_, direction);
    Composite composite;
    RayCost cost;
    bool first = true;
    ReferenceVolume::March march = volume_ && ray ? volume_->begin(i, j, *ray) : ReferenceVolume::March{};
    const auto see_volume = [&](double end) {
      if (volume_) volume_->integrate(*ray, direction, end, march, composite, cost);
      return !volume_ || !volume_->opaque(composite);
    };
    const auto add = [&](const Crossing& crossing) {
      if (!see_volume(crossing.s)) return false;
      const Isosurface& surface = surfaces_[crossing.surface];
      const glm::dvec3 normal = normal_at(tracer_.place(*ray, crossing.s), direction);
      if (first) {
        picture_.depth[pixel] = float(ray->distance(crossing.s));
        for (int a = 0; a < 3; ++a) picture_.normal[3 * pixel + a] = float(normal[a]);
      }
      first = false;
      composite.behind(headlight(surface.color, scene_.ambient, normal, direction), surface.opacity);
      return composite.transmittance > 0.0;
    };
    if (ray && !surfaces_.empty()) tracer_.trace(*ray, work, cost, std::cref(add));
    if (ray && composite.transmittance > 0.0) see_volume(ray->length);
    if (march.half && surfaces_.empty()) picture_.depth[pixel] = float(ray->distance(*march.half));

    const glm::dvec3 color = composite.color + composite.transmittance * scene_.background;
    for (int c = 0; c < 3; ++c) picture_.color[4 * pixel + c] = float(color[c]);
    picture_.color[4 * pixel + 3] = float(1.0 - composite.transmittance);
    if (!scene_.cost) return;
    picture_.cost[3 * pixel] = float(cost.evaluations);
    picture_.cost[3 * pixel + 1] = float(cost.steps);
    picture_.cost[3 * pixel + 2] = float(cost.intervals);
  }

  glm::dvec3 normal_at(const glm::dvec3& u, const glm::dvec3& direction) const {
    const glm::dvec3 gradient = scene_.normal == Normal::analytic
                                    ? spline_.evaluate(coefficients_, u).gradient
                                    : central_difference(spline_, coefficients_, u, difference_step(scene_, coefficients_.lattice));
    return facing_normal(coefficients_.world.gradient_to_world(gradient), direction);
  }

  const Spline& spline_;
  const Coefficients<double>& coefficients_;
  const Scene& scene_;
  std::vector<Isosurface> surfaces_;
  Tracer tracer_;
  std::optional<ReferenceVolume> volume_;
  CameraFrame frame_;
  RaySpace space_;
  Frame picture_;
};

}  // namespace

Frame render_reference(const Spline& spline, const Coefficients<double>& coefficients, const Scene& scene,
                       const CellBounds* cells, const Progress& progress, const VoidCells* voids) {
  check_scene(scene);
  Painter painter(spline, coefficients, scene, cells, voids);
  // Paint a batch of tiles at a time, in parallel; between batches this thread reports.
  const int tiles = painter.tiles();
  const int batch = std::max(64, 16 * tbb::this_task_arena::max_concurrency());
  for (int begin = 0; begin < tiles; begin += batch) {
    report(progress, double(begin) / tiles);
    tbb::parallel_for(begin, std::min(begin + batch, tiles), [&](int tile) { painter.paint_tile(tile); });
  }
  report(progress, 1.0);
  return painter.finish();
}

}  // namespace quincunx

#include "bench/watertight.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "lattice/field.h"
#include "lattice/volume.h"
#include "bench/open_device.h"
#include "render/device_renderer.h"

namespace quincunx {
namespace {

using Vec = glm::dvec3;
constexpr std::int64_t kCells = 127;
constexpr int kPlaces = 128;  // along a ray

/// A function that is positive inside, with its gradient.
struct Solid {
  std::string name;
  std::function<double(const Vec&)> value;
  std::function<Vec(const Vec&)> gradient;
  double inside;  ///< a value that is certainly above the isovalue 0 on either lattice
};

Solid solid_of(const std::string& name) {
  const std::shared_ptr<Field> field = make_field(name);
  if (name != "gyroid") return {name, [field](const Vec& x) { return field->value(x); }, [field](const Vec& x) { return field->gradient(x); }, 0.01};
  // Closed by |x| < 0.85 or so.
  const auto fall = [](const Vec& x) { return 3.0 * std::pow(glm::dot(x, x) / 0.7225, 4.0); };
  return {"gyroid in a ball", [field, fall](const Vec& x) { return field->value(x) - fall(x); },
          [field](const Vec& x) {
            const double r2 = glm::dot(x, x) / 0.7225;
            return field->gradient(x) - 3.0 * 4.0 * std::pow(r2, 3.0) * (2.0 / 0.7225) * x;
          },
          0.05};
}

Volume sampled(const Solid& solid, LatticeKind lattice) {
  Volume volume;
  volume.lattice = lattice;
  volume.extents = Extents(lattice == LatticeKind::bcc ? (kCells + 1) / 2 : kCells + 1);
  volume.world.axes = glm::dmat3(2.0 / double(kCells));
  volume.world.origin = Vec(-1.0);
  std::vector<float> samples;
  const std::int64_t step = lattice_step(lattice);
  for (int c = 0; c < coset_count(lattice); ++c)
    for (std::int64_t k = 0; k < volume.extents.z; ++k)
      for (std::int64_t j = 0; j < volume.extents.y; ++j)
        for (std::int64_t i = 0; i < volume.extents.x; ++i)
          samples.push_back(float(solid.value(volume.world.to_world(Vec(step * i + c, step * j + c, step * k + c)))));
  volume.samples = std::move(samples);
  return volume;
}

/// From any side, from afar and from near, a wide or a narrow look at a place of the middle.
Camera random_camera(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return glm::normalize(Vec(normal(random), normal(random), normal(random))); };
  Camera camera;
  const double distance = std::exp2(1.5 + 1.5 * uniform(random));  // 1 to 8
  camera.eye = distance * direction();
  camera.target = 0.6 * Vec(uniform(random), uniform(random), uniform(random));
  camera.up = glm::normalize(glm::cross(camera.target - camera.eye, direction()));
  camera.fov = glm::degrees(2.0 * std::atan(0.7 * std::exp2(uniform(random)) / distance));
  return camera;
}

/// The first place along the ray, as a distance from the eye, whose value is at least `inside`; infinite where there is none.
double first_inside(const Solid& solid, const Vec& eye, const Vec& direction) {
  // The part in a ball that holds all of the solid.
  const double radius = 0.99, b = glm::dot(eye, direction), c = glm::dot(eye, eye) - radius * radius, d = b * b - c;
  if (d <= 0.0) return HUGE_VAL;
  const double from = std::max(-b - std::sqrt(d), 0.0), to = -b + std::sqrt(d);
  for (int n = 0; n < kPlaces && to > 0.0; ++n) {
    const double t = from + (n + 0.5) / kPlaces * (to - from);
    if (solid.value(eye + t * direction) >= solid.inside) return t;
  }
  return HUGE_VAL;
}

void look(const Solid& solid, const Scene& scene, const Frame& frame, WatertightLine& line) {
  const CameraFrame camera = camera_frame(scene.camera, scene.width, scene.height);
  const double cell = 2.0 / double(kCells);
  // A ray that begins inside has no surface to meet.
  const bool starts_inside = solid.value(scene.camera.eye) > -solid.inside && glm::length(scene.camera.eye) < 1.8;
  std::vector<WatertightLine> rows(static_cast<std::size_t>(scene.height));
  tbb::parallel_for(0, scene.height, [&](int j) {
    WatertightLine& row = rows[std::size_t(j)];
    for (int i = 0; i < scene.width; ++i) {
      const Vec direction = pixel_direction(camera, scene.width, scene.height, i, j);
      const double depth = frame.depth[std::size_t(j) * std::size_t(scene.width) + std::size_t(i)];
      if (std::isfinite(depth)) {
        ++row.hits;
        const Vec x = scene.camera.eye + depth * direction;
        row.off = std::max(row.off, std::abs(solid.value(x)) / glm::length(solid.gradient(x)) / cell);
      }
      const double inside = starts_inside ? HUGE_VAL : first_inside(solid, scene.camera.eye, direction);
      if (std::isinf(inside)) continue;
      ++row.rays;
      row.leaks += !(depth <= inside);
    }
  });
  for (const WatertightLine& row : rows) {
    line.rays += row.rays;
    line.leaks += row.leaks;
    line.hits += row.hits;
    line.off = std::max(line.off, row.off);
  }
}

}  // namespace

std::vector<WatertightLine> measure_watertight(const WatertightPlan& plan, std::string& device, const Progress& progress) {
  const auto kernels = std::make_shared<KernelCache>(open_device(plan.device));
  const std::array<std::string, 3> names{"sphere", "torus", "gyroid"};
  device = gpu::info(kernels->device()).name;
  const double all = double(names.size() * plan.splines.size());
  std::vector<WatertightLine> lines;
  for (const std::string& name : names)
    for (const std::string& spline : plan.splines) {
      const Solid solid = solid_of(name);
      Renderer::Config config;
      config.spline = spline;
      DeviceRenderer renderer(kernels, sampled(solid, make_spline(spline)->lattice()), config);
      Renderer::Request request;
      request.scene.isosurfaces = {Isosurface{}};
      request.scene.width = request.scene.height = plan.size;
      std::mt19937 random(plan.seed);
      WatertightLine line{solid.name, spline};
      while (line.rays < plan.rays) {
        report(progress, (double(lines.size()) + double(line.rays) / double(plan.rays)) / all);
        request.scene.camera = random_camera(random);
        RenderStats stats;
        look(solid, request.scene, renderer.render(request, stats), line);
      }
      lines.push_back(line);
    }
  report(progress, 1.0);
  return lines;
}

}  // namespace quincunx

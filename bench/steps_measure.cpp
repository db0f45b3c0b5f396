#include "bench/steps_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "lattice/field.h"

namespace quincunx {
namespace {

constexpr double kRadius2 = SphereLook::kRadius * SphereLook::kRadius;

/// How far from the origin the ray of pixel (i,j) passes.
double distance_of(const Scene& scene, const CameraFrame& frame, int i, int j) {
  const glm::dvec3 along = pixel_direction(frame, scene.width, scene.height, i, j);
  return glm::length(glm::cross(scene.camera.eye, along));
}

void compare_alpha(const Scene& scene, const Frame& frame, StepLine::Way& way) {
  const CameraFrame camera = camera_frame(scene.camera, scene.width, scene.height);
  double squares = 0.0;
  std::size_t met = 0;
  way.largest = 0.0;
  for (int j = 0; j < scene.height; ++j)
    for (int i = 0; i < scene.width; ++i) {
      const double distance = distance_of(scene, camera, i, j);
      if (distance >= SphereLook::kRadius) continue;
      const double off = frame.color[4 * (std::size_t(j) * std::size_t(scene.width) + std::size_t(i)) + 3] - SphereLook::alpha(distance);
      squares += off * off;
      way.largest = std::max(way.largest, std::abs(off));
      ++met;
    }
  way.rms = std::sqrt(squares / double(std::max<std::size_t>(met, 1)));
}

struct StepsSubject {
  std::unique_ptr<Renderer> renderer;
  Renderer::Request request;
};

StepsSubject make_subject(const StepsPlan& plan, const std::string& spline) {
  const LatticeKind lattice = make_spline(spline)->lattice();
  const Extents extents(lattice == LatticeKind::bcc ? plan.cells / 2 : plan.cells);
  const Volume volume = sample_field(*make_field("sphere"), lattice, extents);
  Renderer::Config config;
  config.spline = spline;
  StepsSubject subject{make_renderer(plan.device, volume, config), {}};
  Scene& scene = subject.request.scene;
  scene.width = scene.height = plan.size;
  scene.camera = framing_camera(lattice, extents, volume.world, {30.0, 10.0, 1.0}, plan.size, plan.size);
  return subject;
}

}  // namespace

DirectVolume SphereLook::volume(Classify classify, double step) {
  DirectVolume volume;
  volume.function = {{{0.0, glm::dvec3(1.0)}}, {{0.0, 0.0}, {kRadius2, kOpacity}}, kUnit};
  volume.classify = classify;
  volume.entries = classify == Classify::post ? 8192 : 1024;
  volume.step = step;
  volume.shade = false;
  volume.termination = 0.0;
  return volume;
}

double SphereLook::alpha(double distance) {
  const double reach2 = kRadius2 - distance * distance;
  if (reach2 <= 0.0) return 0.0;
  const double k = kOpacity / kRadius2, a = 1.0 - k * reach2, s = std::sqrt(reach2);
  return -std::expm1(2.0 / kUnit * (-2.0 * s + 2.0 * std::sqrt(a / k) * std::atan(s * std::sqrt(k / a))));
}

std::vector<StepLine> measure_steps(const StepsPlan& plan, std::string& device, const Progress& progress) {
  std::vector<StepLine> lines;
  const double all = double(plan.splines.size() * plan.steps.size()) * 2.0 * double(plan.rounds + 1);
  double done = 0.0;
  for (const std::string& spline : plan.splines) {
    StepsSubject subject = make_subject(plan, spline);
    const std::size_t first = lines.size();
    for (const double step : plan.steps) lines.push_back({spline, step, {}, {}});
    for (int round = -1; round < plan.rounds; ++round) {  // the first one compiles, and is compared
      for (std::size_t n = first; n < lines.size(); ++n) {
        for (const auto& [classify, way] : {std::pair{Classify::post, &lines[n].post}, {Classify::pre_integrated, &lines[n].pre_integrated}}) {
          report(progress, done++ / all);
          subject.request.scene.volume = SphereLook::volume(classify, lines[n].step);
          RenderStats stats;
          const Frame frame = subject.renderer->render(subject.request, stats);
          device = stats.device;
          if (round >= 0) way->frame_ms.push_back(stats.trace_ms.front());
          if (round < 0) compare_alpha(subject.request.scene, frame, *way);
        }
      }
    }
  }
  return lines;
}

}  // namespace quincunx

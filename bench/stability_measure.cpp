#include "bench/stability_measure.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "bench/huge_volume.h"
#include "bench/open_device.h"
#include "lattice/error.h"
#include "render/device_probe.h"
#include "render/device_renderer.h"
#include "render/tracer.h"

namespace quincunx {
namespace {

constexpr double kFloatEpsilon = 0x1p-24;
constexpr double kDoubleEpsilon = 0x1p-48;  // of doubles, 2^-53, and of the reference's own rounding
constexpr double kLeast = 1e-300;         // of m: all coefficients may be 0
constexpr std::size_t kHugeWeight = 200;   // of the progress, in cases
constexpr double kOwnRounding = 0x1p-44;  // of the double-precision spline, relative to its coefficients

/// One volume, as doubles and on the device.
struct Subject {
  const Spline& spline;
  Volume volume;
  Coefficients<double> coefficients;
  Coefficients<float> rounded;
};

/// A place inside the piece that a kernel takes for u, so that a gradient that jumps can be that of the same piece: in the cell of u, and of the
/// cell's own coordinates (on the BCC lattice from its even corner on) equal ones descend in the order of the axes.
glm::dvec3 inside_piece(const Coefficients<float>& c, const glm::dvec3& u) {
  const glm::ivec3 cell = cell_of(u, domain_max(c.lattice, c.extents)), odd = c.lattice == LatticeKind::bcc ? cell & 1 : glm::ivec3(0);
  return glm::dvec3(cell + odd) + glm::dvec3(1 - 2 * odd) * glm::dvec3(0.6, 0.5, 0.4);
}

/// The error of values and gradients at random points of the domain, a quarter of them in the planes of the lattice.
EvaluationError evaluation_error(const Subject& subject, gpu::Device& device, const StabilityPlan& plan) {
  const Coefficients<float>& c = subject.rounded;
  const glm::dvec3 far(domain_max(c.lattice, c.extents));
  std::mt19937 random(plan.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<glm::dvec3> points(static_cast<std::size_t>(plan.points));
  for (glm::dvec3& u : points)
    for (int a = 0; a < 3; ++a) {
      u[a] = far[a] * uniform(random);
      if (uniform(random) < 0.25) u[a] = std::rint(u[a]);
    }
  const std::vector<Jet> jets = probe_spline(device, subject.spline, c, 0.0, points);

  EvaluationError error;
  error.value_allowed = kernel_rounding(subject.spline);
  error.gradient_allowed = subject.spline.degree() * error.value_allowed;
  // In the unit of the rounded coefficients, so that doubles lose nothing to an offset either.
  Coefficients<double> exact = subject.coefficients;
  for (double& number : exact.data) number = c.unit.number(number);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const glm::dvec3 u = glm::clamp(points[n], glm::dvec3(0.0), far);
    const Jet truth = subject.spline.evaluate(exact, u + 1e-9 * (glm::min(inside_piece(c, u), far) - u));
    const double m = std::max(local_magnitude(exact, u, 0.0), kLeast), own = kOwnRounding * m;
    const auto off = [&](double found, double expected) { return std::max(std::abs(found - expected) - own, 0.0) / (kFloatEpsilon * m); };
    error.value = std::max(error.value, off(jets[n].value, truth.value));
    for (int a = 0; a < 3; ++a) error.gradient = std::max(error.gradient, off(jets[n].gradient[a], truth.gradient[a]));
  }
  return error;
}

Renderer::Request request_for(const StabilityCase& c, const Camera& camera) {
  Renderer::Request request;
  request.scene.isosurfaces = {Isosurface{.isovalue = c.isovalue}};
  request.scene.camera = camera;
  request.scene.width = request.scene.height = c.size;
  return request;
}

/// Whether rendering the volume is refused for samples that are not finite, naming their number and a place.
bool refuses(const Volume& volume, const Renderer::Config& config, const std::shared_ptr<KernelCache>& kernels, const Renderer::Request& request) {
  try {
    RenderStats stats;
    DeviceRenderer(kernels, volume, config).render(request, stats);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.find(std::to_string(sample_range(volume).not_finite)) != std::string::npos && what.find("first") != std::string::npos;
  }
  return false;
}

StabilityLine measure_case(const StabilityCase& c, const std::string& name, const std::shared_ptr<KernelCache>& kernels, const StabilityPlan& plan) {
  const std::unique_ptr<Spline> spline = make_spline(name);
  Subject subject{*spline, c.sampled(spline->lattice()), {}, {}};
  Renderer::Config config;
  config.spline = name;
  config.nan = c.nan;
  if (sample_range(subject.volume).not_finite > 0 && c.nan.kind == NanPolicy::Kind::refuse) {
    StabilityLine line;
    line.group = c.group, line.name = c.name, line.spline = name, line.isovalue = c.isovalue;
    line.refused = refuses(subject.volume, config, kernels, request_for(c, c.views(spline->lattice()).front()));
    return line;
  }
  DeviceRenderer renderer(kernels, subject.volume, config);
  std::optional<DeviceRenderer> doubles;
  if (gpu::features(kernels->device()).float64) {
    config.precision = Precision::float64;
    doubles.emplace(kernels, subject.volume, config);
  }
  const VoidCells voids = make_finite(subject.volume, *spline, c.nan);
  subject.coefficients = spline->coefficients(subject.volume, Spline::Prefilter::automatic);
  const SampleRange range = sample_range(subject.volume);
  subject.rounded = spline->coefficients_float(subject.volume, Spline::Prefilter::automatic, float_unit(c.type, range.min, range.max));
  const double shift = value_rounding(subject.coefficients);
  // Bounds of the rounded coefficients are those of the values where they are rounded as they are.
  const CellBounds bounds = cell_bounds(*spline, subject.rounded);

  StabilityLine line{c.group, c.name, name, c.isovalue, evaluation_error(subject, kernels->device(), plan), {}, {}, {}, {}};
  for (const Camera& camera : c.views(spline->lattice())) {
    Renderer::Request request = request_for(c, camera);
    const Judge judge(*spline, subject.coefficients, request.scene, subject.rounded.unit.plain() ? &bounds : nullptr, &voids);
    const Judge::Config floats{.epsilon = kFloatEpsilon, .offset = subject.rounded.unit.offset, .shift = 0.0, .cells = glm::i64vec3(0)};
    RenderStats stats;
    line.exact += judge.judge(renderer.render(request, stats), floats);
    if (doubles) line.doubles += judge.judge(doubles->render(request, stats), {.epsilon = kDoubleEpsilon, .offset = floats.offset, .shift = shift, .cells = glm::i64vec3(0)});
    request.scene.intersect = Intersect::march;
    request.scene.step = plan.step;
    line.march += judge.judge(renderer.render(request, stats), floats);
  }
  return line;
}

}  // namespace

void measure_stability(const StabilityPlan& plan, std::vector<StabilityLine>& lines, std::string& device, const Progress& progress) {
  const auto kernels = std::make_shared<KernelCache>(open_device(plan.device));
  device = gpu::info(kernels->device()).name;
  const double all = double((plan.cases.size() + (plan.huge ? kHugeWeight : 0)) * plan.splines.size());
  for (const StabilityCase& c : plan.cases)
    for (const std::string& spline : plan.splines) {
      report(progress, double(lines.size()) / all);
      lines.push_back(measure_case(c, spline, kernels, plan));
    }
  if (plan.huge) {
    for (std::size_t n = 0; n < plan.splines.size(); ++n) {
      const double before = double(plan.cases.size() * plan.splines.size() + n * kHugeWeight);
      lines.push_back(measure_huge(plan.splines[n], kernels, [&](double done) { report(progress, (before + kHugeWeight * done) / all); }));
    }
  }
  report(progress, 1.0);
}

}  // namespace quincunx

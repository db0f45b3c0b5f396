#include "bench/compare_measure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>
#include <utility>

#include "accel/bounds.h"
#include "app/render_report.h"
#include "render/device_renderer.h"
#include "render/reference.h"
#include "render/shading.h"
#include "spline/storage.h"

namespace quincunx {
namespace {

/// One spline of one volume: its double-precision reference.
struct Reference {
  CompareSetting setting;  ///< the first one that uses it
  std::unique_ptr<Spline> spline;
  Coefficients<double> coefficients;
  std::vector<Frame> frames;  ///< a view each
};

/// What is on the device.
struct Rendered {
  CompareSetting setting;  ///< the first one that uses it
  std::unique_ptr<DeviceRenderer> renderer;
};

/// Progress of stages that take a share each.
class Shares {
 public:
  Shares(const Progress& progress, double parts) : progress_(progress), parts_(parts) {}
  Progress next(double share = 1.0) {
    const double begin = done_;
    done_ += share;
    return [this, begin, share](double fraction) { report(progress_, std::min((begin + share * fraction) / parts_, 1.0)); };
  }

 private:
  const Progress& progress_;
  double parts_, done_ = 0.0;
};

Scene exact_scene(Scene scene) {
  scene.intersect = Intersect::exact;
  scene.normal = Normal::analytic;
  return scene;
}

Reference make_reference(const CompareSubject& subject, const CompareSetting& setting, const std::vector<Renderer::Request>& views, const Progress& progress) {
  const Volume& volume = subject.volumes[setting.volume].volume;
  Reference r;
  r.setting = setting;
  r.spline = make_spline(setting.spline, volume.lattice);
  r.coefficients = r.spline->coefficients(volume, setting.prefilter);
  const CellBounds cells = cell_bounds(*r.spline, narrowed(r.coefficients));
  for (std::size_t v = 0; v < views.size(); ++v)
    r.frames.push_back(render_reference(*r.spline, r.coefficients, exact_scene(views[v].scene), &cells,
                                        [&](double fraction) { report(progress, (double(v) + fraction) / double(views.size())); }));
  return r;
}

Rendered make_rendered(const CompareSubject& subject, const CompareSetting& setting, const std::shared_ptr<KernelCache>& kernels) {
  Renderer::Config config;
  config.spline = setting.spline;
  config.prefilter = setting.prefilter;
  config.storage = setting.storage;
  return {setting, std::make_unique<DeviceRenderer>(kernels, subject.volumes[setting.volume].volume, config)};
}

/// The settings of which none is alike to one before.
template <class Alike>
std::vector<CompareSetting> distinct(const std::vector<CompareSetting>& settings, const Alike& alike) {
  std::vector<CompareSetting> found;
  for (const CompareSetting& s : settings)
    if (std::none_of(found.begin(), found.end(), [&](const CompareSetting& d) { return alike(d, s); })) found.push_back(s);
  return found;
}
bool one_spline(const CompareSetting& a, const CompareSetting& b) { return a.same_spline(b); }
bool one_renderer(const CompareSetting& a, const CompareSetting& b) { return a.same_coefficients(b); }

/// The one of `all` whose setting is alike.
template <class T, class Alike>
T& found(std::vector<T>& all, const CompareSetting& setting, const Alike& alike) {
  return *std::find_if(all.begin(), all.end(), [&](const T& t) { return alike(t.setting, setting); });
}

/// In double precision, as a device decodes them.
Coefficients<double> decoded(const CompareSubject& subject, const CompareSetting& setting, const Reference& reference) {
  if (setting.storage == Storage::float32) return reference.coefficients;
  return values_of(stored_coefficients(*reference.spline, subject.volumes[setting.volume].volume, setting.prefilter, setting.storage));
}

/// Whether each pixel of `frame` has a hit near the border of the domain.
std::vector<char> near_border(const CompareSubject& subject, const Scene& scene, const Frame& frame) {
  const CameraFrame camera = camera_frame(scene.camera, scene.width, scene.height);
  std::vector<char> near(frame.depth.size(), 0);
  for (int j = 0; j < scene.height; ++j)
    for (int i = 0; i < scene.width; ++i) {
      const std::size_t p = std::size_t(j) * std::size_t(scene.width) + std::size_t(i);
      const double depth = frame.depth[p];
      if (std::isfinite(depth)) near[p] = !subject.inside(scene.camera.eye + depth * pixel_direction(camera, scene.width, scene.height, i, j));
    }
  return near;
}

/// `frame` with what is left out of the comparison taken from `other`.
Frame where_compared(Frame frame, const Frame& other, const std::vector<char>& left_out) {
  for (std::size_t p = 0; p < left_out.size(); ++p)
    if (left_out[p]) std::copy_n(other.color.begin() + std::ptrdiff_t(4 * p), 4, frame.color.begin() + std::ptrdiff_t(4 * p));
  return frame;
}

/// The truth of each view.
struct TrueView {
  const Scene* scene;
  Frame frame;
  std::vector<char> near_border;
};

std::vector<TrueView> true_views(const CompareSubject& subject, const std::vector<Renderer::Request>& views, const Progress& progress) {
  std::vector<TrueView> all;
  if (!subject.truth) return all;
  for (std::size_t v = 0; v < views.size(); ++v) {
    Frame frame = subject.truth->frame(views[v].scene, [&](double fraction) { report(progress, (double(v) + fraction) / double(views.size())); });
    std::vector<char> near = near_border(subject, views[v].scene, frame);
    all.push_back({&views[v].scene, std::move(frame), std::move(near)});
  }
  return all;
}

/// Gathers what is wrong with a line's pictures.
struct Errors {
  FrameComparison reference, truth;
  double image_rmse = 0.0, ssim = 0.0;

  std::uint64_t left_out = 0;

  void add(const CompareSubject& subject, const Frame& frame, const Frame& expected, const TrueView* true_view) {
    const auto length = [&](std::size_t) { return subject.cell; };
    reference.add(frame, expected, length);
    if (!true_view) {
      image_rmse += quincunx::image_rmse(frame, expected);
      ssim += structural_similarity(frame, expected);
      return;
    }
    std::vector<char> out = near_border(subject, *true_view->scene, frame);
    for (std::size_t p = 0; p < out.size(); ++p) out[p] = out[p] || true_view->near_border[p];
    left_out += std::uint64_t(std::count(out.begin(), out.end(), 1));
    truth.add(frame, true_view->frame, length, [&](std::size_t p) { return !out[p]; });
    const Frame compared = where_compared(frame, true_view->frame, out);
    image_rmse += quincunx::image_rmse(compared, true_view->frame);
    ssim += structural_similarity(compared, true_view->frame);
  }
};

/// Random points inside the border, uniform in the box of the first volume.
std::vector<glm::dvec3> random_points(const CompareSubject& subject, int count, std::uint32_t seed) {
  const Volume& volume = subject.volumes.front().volume;
  const glm::dvec3 far(domain_max(volume.lattice, volume.extents));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<glm::dvec3> points;
  while (int(points.size()) < count) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const glm::dvec3 place = volume.world.to_world(far * glm::dvec3(x, y, z));
    if (subject.inside(place)) points.push_back(place);
  }
  return points;
}

}  // namespace

VolumeErrors volume_errors(const CompareSubject& subject, const CompareSetting& setting, const Spline& spline, const Coefficients<double>& coefficients,
                           int points, std::uint32_t seed) {
  assert(subject.truth);
  const std::vector<glm::dvec3> places = random_points(subject, points, seed);
  Scene differences;
  differences.normal = setting.normal.normal;
  differences.delta = setting.normal.delta;
  std::vector<double> off(places.size()), slope_squares(places.size()), angles(places.size());
  tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t n) {
    const World& world = coefficients.world;
    const glm::dvec3 u = world.to_lattice(places[n]);
    Jet jet = spline.evaluate(coefficients, u);
    if (differences.normal != Normal::analytic) jet.gradient = central_difference(spline, coefficients, u, difference_step(differences, coefficients.lattice));
    const Jet truth = subject.truth->at(places[n]);
    const glm::dvec3 gradient = world.gradient_to_world(jet.gradient), difference = gradient - truth.gradient;
    off[n] = std::abs(jet.value - truth.value);
    slope_squares[n] = glm::dot(difference, difference);
    angles[n] = angle_degrees(gradient, truth.gradient);
  });
  VolumeErrors errors;
  for (std::size_t n = 0; n < places.size(); ++n) {
    errors.value_rmse += off[n] * off[n];
    errors.value_max = std::max(errors.value_max, off[n]);
    errors.gradient_rmse += slope_squares[n];
    errors.angle_rms += angles[n] * angles[n];
  }
  for (double* mean : {&errors.value_rmse, &errors.gradient_rmse, &errors.angle_rms}) *mean = std::sqrt(*mean / double(places.size()));
  errors.angle_p99 = percentile(angles, 0.99);
  return errors;
}

CompareMeasurement measure_compare(const CompareSubject& subject, const ComparePlan& plan, const std::shared_ptr<KernelCache>& kernels, const Progress& progress) {
  Renderer::Request request;
  request.scene.isosurfaces = {Isosurface{.isovalue = subject.isovalue}};
  request.scene.width = plan.width;
  request.scene.height = plan.height;
  const std::vector<Renderer::Request> views = orbit_views(request, subject.volumes.front().volume, plan.views, plan.first);

  const std::vector<CompareSetting> splines = distinct(plan.settings, one_spline);
  const double count = double(plan.settings.size());
  Shares shares(progress, 1.0 + 2.0 * double(splines.size()) + count * 0.1 * double(plan.views * (plan.rounds + 3)));
  const std::vector<TrueView> truths = true_views(subject, views, shares.next());
  std::vector<Reference> references;
  for (const CompareSetting& s : splines) references.push_back(make_reference(subject, s, views, shares.next(2.0)));
  std::vector<Rendered> rendered;
  for (const CompareSetting& s : distinct(plan.settings, one_renderer)) rendered.push_back(make_rendered(subject, s, kernels));

  CompareMeasurement result;
  if (!truths.empty()) result.truth = truths.front().frame;
  std::vector<Errors> errors(plan.settings.size());
  for (const CompareSetting& s : plan.settings) {
    CompareLine line;
    line.setting = s;
    const Reference& r = found(references, s, one_spline);
    const auto before = std::find_if(result.lines.begin(), result.lines.end(), [&](const CompareLine& l) { return l.setting.same_reconstruction(s); });
    if (before != result.lines.end()) {
      line.volume = before->volume;
    } else if (subject.truth) {
      line.volume = volume_errors(subject, s, *r.spline, decoded(subject, s, r), plan.points, plan.seed);
    }
    result.references.push_back(r.frames.front());
    result.lines.push_back(std::move(line));
  }

  // Round by round, view by view, each setting's frame in its turn. The first round also compiles, and is looked at.
  for (int round = -1; round < plan.rounds; ++round)
    for (std::size_t v = 0; v < views.size(); ++v)
      for (std::size_t n = 0; n < plan.settings.size(); ++n) {
        const Progress part = shares.next(round < 0 ? 0.3 : 0.1);
        report(part, 0.0);
        CompareLine& line = result.lines[n];
        RenderStats stats;
        Frame frame = found(rendered, line.setting, one_renderer).renderer->render(line.setting.applied(views[v]), stats);
        if (round >= 0) {
          line.frame_ms.push_back(stats.trace_ms.front());
          continue;
        }
        result.device = stats.device;
        for (const auto& [what, bytes] : stats.device_bytes)
          if (what == "coefficients") line.coefficient_bytes = bytes;
        errors[n].add(subject, frame, found(references, line.setting, one_spline).frames[v], truths.empty() ? nullptr : &truths[v]);
        if (v == 0) line.picture = std::move(frame);
      }

  for (std::size_t n = 0; n < plan.settings.size(); ++n) {
    CompareLine& line = result.lines[n];
    line.reference = errors[n].reference.errors();
    if (subject.truth) line.truth = errors[n].truth.errors();
    line.left_out = errors[n].left_out;
    line.image_rmse = errors[n].image_rmse / plan.views;
    line.ssim = errors[n].ssim / plan.views;
  }
  return result;
}

}  // namespace quincunx

#include "bench/continuum.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "accel/bounds.h"
#include "lattice/shared_progress.h"
#include "render/reference.h"
#include "render/shading.h"

namespace quincunx {
namespace {

/// The part of o + t d inside [-1,1]^3, t >= 0.
std::optional<std::pair<double, double>> inside_cube(const glm::dvec3& o, const glm::dvec3& d) {
  double begin = 0.0, end = std::numeric_limits<double>::max();
  for (int a = 0; a < 3; ++a) {
    if (d[a] == 0.0) {
      if (std::abs(o[a]) > 1.0) return std::nullopt;
      continue;
    }
    const double t0 = (-1.0 - o[a]) / d[a], t1 = (1.0 - o[a]) / d[a];
    begin = std::max(begin, std::min(t0, t1)), end = std::min(end, std::max(t0, t1));
  }
  if (!(begin < end)) return std::nullopt;
  return std::pair(begin, end);
}

/// The place between a and b where `f` changes sign, by bisection to the last bit.
template <class F>
double bisect(double a, double b, const F& f) {
  const bool above = f(a) >= 0.0;
  for (int n = 0; n < 200; ++n) {
    const double middle = 0.5 * (a + b);
    if (middle <= a || middle >= b) break;
    ((f(middle) >= 0.0) == above ? a : b) = middle;
  }
  return b;
}

class FieldContinuum final : public Continuum {
 public:
  FieldContinuum(const Field& field, double step) : field_(field), step_(step) {}

  Jet at(const glm::dvec3& x) const override { return {field_.value(x), field_.gradient(x)}; }

  Frame frame(const Scene& scene, const Progress& progress) const override {
    const CameraFrame camera = camera_frame(scene.camera, scene.width, scene.height);
    const std::size_t pixels = std::size_t(scene.width) * std::size_t(scene.height);
    Frame frame{scene.width, scene.height, std::vector<float>(4 * pixels), std::vector<float>(pixels), std::vector<float>(3 * pixels), {}};
    SharedProgress shared(progress, scene.height);
    tbb::parallel_for(0, scene.height, [&](int j) {
      for (int i = 0; i < scene.width; ++i)
        see(scene, pixel_direction(camera, scene.width, scene.height, i, j), std::size_t(j) * std::size_t(scene.width) + std::size_t(i), frame);
      shared.add(1);
    });
    return frame;
  }

 private:
  /// The first root along a ray; a ray that begins above the isovalue has none there.
  std::optional<double> first_hit(const glm::dvec3& o, const glm::dvec3& d, double isovalue) const {
    const auto range = inside_cube(o, d);
    if (!range) return std::nullopt;
    const auto value = [&](double t) { return field_.value(o + t * d) - isovalue; };
    const auto slope = [&](double t) { return glm::dot(field_.gradient(o + t * d), d); };
    const int count = int(std::ceil((range->second - range->first) / step_));
    const auto place = [&](int n) { return n == count ? range->second : range->first + (range->second - range->first) * n / count; };
    const bool above = value(range->first) >= 0.0;
    double before = range->first, slope_before = slope(before);
    for (int n = 1; n <= count; ++n) {
      const double t = place(n), slope_here = slope(t);
      if ((value(t) >= 0.0) != above) return bisect(before, t, value);
      // Towards the isovalue at one end and away from it at the other: it turns round between.
      const bool turns = above ? slope_before < 0.0 && slope_here > 0.0 : slope_before > 0.0 && slope_here < 0.0;
      if (turns) {
        const double turn = bisect(before, t, slope);
        if ((value(turn) >= 0.0) != above) return bisect(before, turn, value);
      }
      before = t, slope_before = slope_here;
    }
    return std::nullopt;
  }

  void see(const Scene& scene, const glm::dvec3& direction, std::size_t pixel, Frame& frame) const {
    const Isosurface& surface = scene.isosurfaces.front();
    const auto hit = first_hit(scene.camera.eye, direction, surface.isovalue);
    Composite seen;
    glm::dvec3 normal(0.0);
    if (hit) {
      normal = facing_normal(field_.gradient(scene.camera.eye + *hit * direction), direction);
      seen.behind(headlight(surface.color, scene.ambient, normal, direction), surface.opacity);
    }
    const glm::dvec3 color = seen.color + seen.transmittance * scene.background;
    for (int a = 0; a < 3; ++a) {
      frame.color[4 * pixel + std::size_t(a)] = float(color[a]);
      frame.normal[3 * pixel + std::size_t(a)] = float(normal[a]);
    }
    frame.color[4 * pixel + 3] = float(1.0 - seen.transmittance);
    frame.depth[pixel] = hit ? float(*hit) : std::numeric_limits<float>::infinity();
  }

  const Field& field_;
  double step_;
};

class SplineContinuum final : public Continuum {
 public:
  SplineContinuum(const Volume& volume, std::string_view spline, Spline::Prefilter prefilter, const Progress& progress)
      : spline_(make_spline(spline, volume.lattice)),
        coefficients_(spline_->coefficients(volume, prefilter, progress)),
        cells_(cell_bounds(*spline_, narrowed(coefficients_), progress)),
        inverse_axes_(glm::inverse(volume.world.axes)),
        far_(domain_max(volume.lattice, volume.extents)) {}

  Jet at(const glm::dvec3& x) const override {
    const glm::dvec3 u = glm::clamp(inverse_axes_ * (x - coefficients_.world.origin), glm::dvec3(0.0), far_);
    const Jet jet = spline_->evaluate(coefficients_, u);
    return {jet.value, glm::transpose(inverse_axes_) * jet.gradient};
  }
  Frame frame(const Scene& scene, const Progress& progress) const override {
    Scene exact = scene;
    exact.intersect = Intersect::exact;
    exact.normal = Normal::analytic;
    return render_reference(*spline_, coefficients_, exact, &cells_, progress);
  }

 private:
  std::unique_ptr<Spline> spline_;
  Coefficients<double> coefficients_;
  CellBounds cells_;
  glm::dmat3 inverse_axes_;
  glm::dvec3 far_;
};

}  // namespace

std::unique_ptr<Continuum> field_continuum(const Field& field, double step) { return std::make_unique<FieldContinuum>(field, step); }

std::unique_ptr<Continuum> spline_continuum(const Volume& volume, std::string_view spline, Spline::Prefilter prefilter, const Progress& progress) {
  return std::make_unique<SplineContinuum>(volume, spline, prefilter, progress);
}

}  // namespace quincunx

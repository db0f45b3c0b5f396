#include "bench/truth.h"

#include <algorithm>
#include <cmath>

namespace quincunx {

Truth::Truth(const Volume& volume, const Progress& progress)
    : spline_(make_spline("bcc7")),
      coefficients_(spline_->coefficients(volume, Spline::Prefilter::automatic, progress)),
      cells_(cell_bounds(*spline_, spline_->coefficients_float(volume, Spline::Prefilter::automatic), progress)) {}

Frame Truth::frame(Scene scene, const Progress& progress) const {
  scene.intersect = Intersect::exact;
  scene.normal = Normal::analytic;
  return render_reference(*spline_, coefficients_, scene, &cells_, progress);
}

Truth::Rays::Rays(const Truth& truth, const Scene& scene)
    : truth_(truth),
      width_(scene.width),
      height_(scene.height),
      camera_(camera_frame(scene.camera, scene.width, scene.height)),
      space_(ray_space(truth.coefficients_.lattice, truth.coefficients_.extents, truth.coefficients_.world,
                       scene.camera.eye)) {}

std::optional<LatticeRay> Truth::Rays::ray(int i, int j) const {
  return clip_ray(space_, pixel_direction(camera_, width_, height_, i, j));
}

double Truth::Rays::residual(const LatticeRay& ray, double depth, double isovalue) const {
  const double s = std::clamp((depth - ray.entry) / ray.scale, 0.0, ray.length);
  const glm::dvec3 u = glm::clamp(ray.point(s), glm::dvec3(0.0), space_.far);
  const Jet jet = truth_.spline_->evaluate(truth_.coefficients_, u);
  const double off = std::abs(jet.value - isovalue);
  return off == 0.0 ? 0.0 : off / glm::length(jet.gradient);
}

}  // namespace quincunx

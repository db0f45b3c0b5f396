// Volumes, a spline and a shorthand for the tests of the casters.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "render/tracer.h"

namespace quincunx {

/// A BCC volume of float samples f(u), u in lattice coordinates.
inline Volume bcc_volume(const Extents& n, const std::function<double(const glm::dvec3&)>& f, const World& world = {}) {
  Volume volume;
  volume.lattice = LatticeKind::bcc;
  volume.extents = n;
  volume.world = world;
  std::vector<float> samples;
  for (int c = 0; c < 2; ++c)
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) samples.push_back(float(f(glm::dvec3(2 * i + c, 2 * j + c, 2 * k + c))));
  volume.samples = std::move(samples);
  return volume;
}

inline Volume cartesian_volume(const Extents& n, const std::function<double(const glm::dvec3&)>& f, const World& world = {}) {
  Volume volume;
  volume.extents = n;
  volume.world = world;
  std::vector<float> samples;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) samples.push_back(float(f(glm::dvec3(i, j, k))));
  volume.samples = std::move(samples);
  return volume;
}

/// Independent samples, uniform in [0, 1].
inline Volume random_volume(const Extents& n, unsigned seed, const World& world = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  return bcc_volume(n, [&](const glm::dvec3&) { return uniform(random); }, world);
}

/// bcc7 of a volume.
struct Sampled {
  std::unique_ptr<Spline> spline = make_spline("bcc7");
  Coefficients<double> coefficients;

  explicit Sampled(const Volume& volume, Spline::Prefilter prefilter = Spline::Prefilter::automatic)
      : coefficients(spline->coefficients(volume, prefilter)) {}
  double value(const glm::dvec3& u) const { return spline->evaluate(coefficients, u).value; }
};

/// A "spline" that is one quadratic polynomial: its restriction to a segment is exact, border or no border.
class QuadraticSpline final : public Spline {
 public:
  using Function = std::function<Jet(const glm::dvec3&)>;
  explicit QuadraticSpline(Function f) : f_(std::move(f)) {}

  std::string_view name() const override { return "quadratic"; }
  LatticeKind lattice() const override { return LatticeKind::bcc; }
  int degree() const override { return 2; }
  int apron() const override { return 0; }
  std::span<const Filter> filters() const override {
    static constexpr Filter none{Prefilter::none, 0, 1.0, 3};
    return {&none, 1};
  }
  std::string_view shader() const override { return ""; }
  Jet generator(const glm::dvec3&) const override { return {}; }
  Jet evaluate(const Coefficients<double>&, const glm::dvec3& u) const override { return f_(u); }
  void split(const glm::ivec3&, const glm::dvec3&, const glm::dvec3&, double, double,
             std::vector<double>&) const override {}
  void restrict_to_segment(const Coefficients<double>&, const glm::ivec3&, const glm::dvec3& a, const glm::dvec3& b,
                           std::span<double> bernstein) const override {
    bernstein[0] = f_(a).value;
    bernstein[2] = f_(b).value;
    bernstein[1] = 2.0 * f_(0.5 * (a + b)).value - 0.5 * (bernstein[0] + bernstein[2]);
  }
  Coefficients<double> coefficients(const Volume&, Prefilter, const Progress&) const override { return {}; }
  Coefficients<float> coefficients_float(const Volume&, Prefilter, const ValueUnit&, const Progress&) const override { return {}; }

  /// Coefficients that say how large the domain is, and the values (for the rounding that the tracer allows).
  static Coefficients<double> domain(const Extents& extents, double largest) {
    Coefficients<double> c;
    c.extents = extents;
    c.data = {largest};
    return c;
  }

 private:
  Function f_;
};

/// All crossings of the ray from `eye` along `direction` (world; need not be unit), as distances from the eye.
inline std::vector<double> crossing_distances(const Tracer& tracer, const Coefficients<double>& c,
                                              const glm::dvec3& eye, const glm::dvec3& direction) {
  std::vector<double> distances;
  const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, eye), glm::normalize(direction));
  if (!ray) return distances;
  Tracer::Workspace work;
  RayCost cost;
  tracer.trace(*ray, work, cost, [&](const Crossing& crossing) {
    distances.push_back(ray->distance(crossing.s));
    return true;
  });
  return distances;
}

/// A direction uniform on the unit sphere.
inline glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

}  // namespace quincunx

// What the tests of splines share: small volumes and slow, plain evaluations.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "lattice/volume.h"
#include "spline/spline.h"

namespace quincunx {

/// Uniform random numbers, the same in every run.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * (engine_() * 0x1p-32); }
  glm::dvec3 point(const glm::dvec3& low, const glm::dvec3& high) {
    const double x = between(low.x, high.x), y = between(low.y, high.y);
    return {x, y, between(low.z, high.z)};
  }

 private:
  std::mt19937 engine_;
};

/// A volume of float samples f(u), u the lattice coordinates of each.
template <class F>
Volume volume_of(LatticeKind lattice, const Extents& extents, const F& f) {
  Volume volume;
  volume.lattice = lattice;
  volume.extents = extents;
  std::vector<float> samples;
  const double step = lattice_step(lattice);
  for (int c = 0; c < coset_count(lattice); ++c)
    for (std::int64_t k = 0; k < extents.z; ++k)
      for (std::int64_t j = 0; j < extents.y; ++j)
        for (std::int64_t i = 0; i < extents.x; ++i)
          samples.push_back(float(f(step * glm::dvec3(i, j, k) + double(c))));
  volume.samples = std::move(samples);
  return volume;
}

inline Volume random_volume(LatticeKind lattice, const Extents& extents, unsigned seed) {
  Random random(seed);
  return volume_of(lattice, extents, [&](const glm::dvec3&) { return random.between(-1.0, 1.0); });
}

/// Calls visit(coset, index, u) for every lattice point u whose coordinates are within `reach` of `centre`.
template <class Visit>
void for_lattice_points(LatticeKind lattice, const glm::dvec3& centre, double reach, const Visit& visit) {
  const double step = lattice_step(lattice);
  for (int c = 0; c < coset_count(lattice); ++c) {
    const glm::i64vec3 low(glm::ceil((centre - reach - double(c)) / step));
    const glm::i64vec3 high(glm::floor((centre + reach - double(c)) / step));
    for (std::int64_t k = low.z; k <= high.z; ++k)
      for (std::int64_t j = low.y; j <= high.y; ++j)
        for (std::int64_t i = low.x; i <= high.x; ++i)
          visit(c, glm::i64vec3(i, j, k), step * glm::dvec3(i, j, k) + double(c));
  }
}

/// Distance of x from the nearest plane 2 x_a integer or x_a +- x_b integer (along an axis): the knot planes of every spline here.
inline double knot_distance(const glm::dvec3& x) {
  double least = 1.0;
  for (const double p : {2.0 * x.x, 2.0 * x.y, 2.0 * x.z}) least = std::min(least, 0.5 * std::abs(p - std::round(p)));
  for (const double p : {x.x + x.y, x.x - x.y, x.y + x.z, x.y - x.z, x.x + x.z, x.x - x.z}) least = std::min(least, std::abs(p - std::round(p)));
  return least;
}

}  // namespace quincunx

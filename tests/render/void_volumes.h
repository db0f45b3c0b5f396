// Volumes with samples that are not finite, for the tests of void cells.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "accel/void_cells.h"
#include "tests/render/volumes.h"

namespace quincunx {

struct VoidVolume {
  std::string name;
  Volume volume;
};

/// A field on `lattice`, about 23 cells along each axis.
inline Volume field_volume(LatticeKind lattice, const std::function<double(const glm::dvec3&)>& f, const World& world = {}) {
  return lattice == LatticeKind::bcc ? bcc_volume({12, 12, 12}, f, world) : cartesian_volume({24, 24, 24}, f, world);
}

/// Waves from about 0 to 1, of which what is not finite is a ball, one sample, a plane, a corner, a little of noise, all, or, in the last one, nothing.
inline std::vector<VoidVolume> void_volumes(LatticeKind lattice, const World& world = {}) {
  using Vec = glm::dvec3;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto waves = [](const Vec& u) { return 0.5 + 0.3 * std::sin(0.5 * u.x + 0.1 * u.z) + 0.25 * std::cos(0.4 * u.y - 0.35 * u.z); };
  const auto make = [&](const std::function<double(const Vec&)>& not_finite) {
    return field_volume(lattice, [&](const Vec& u) { const double n = not_finite(u); return n == 0.0 ? waves(u) : n; }, world);
  };
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<VoidVolume> all;
  all.push_back({"ball", make([&](const Vec& u) { return glm::length(u - Vec(12, 11, 10)) < 6.0 ? nan : 0.0; })});
  all.push_back({"one sample", make([&](const Vec& u) { return u == Vec(10, 12, 8) ? nan : 0.0; })});
  all.push_back({"plane", make([&](const Vec& u) { return u.y == 9.0 || u.y == 10.0 ? nan : 0.0; })});
  all.push_back({"corner", make([&](const Vec& u) { return u.x > 14.0 && u.y < 9.0 && u.z > 12.0 ? nan : 0.0; })});
  all.push_back({"infinities", make([&](const Vec& u) { return glm::length(u - Vec(5, 15, 12)) < 3.0 ? -inf : glm::length(u - Vec(15, 6, 8)) < 4.0 ? inf : 0.0; })});
  all.push_back({"a few of all", make([&](const Vec&) { return uniform(random) < 0.003 ? nan : 0.0; })});
  all.push_back({"all", make([&](const Vec&) { return nan; })});
  all.push_back({"none", make([&](const Vec&) { return 0.0; })});
  return all;
}

/// The volume as it is extended where it is not finite, its coefficients and its void cells.
struct Emptied {
  std::unique_ptr<Spline> spline;
  Volume volume;
  VoidCells voids;
  Coefficients<double> coefficients;

  Emptied(const Volume& holed, std::string_view name)
      : spline(make_spline(name)), volume(holed), voids(make_finite(volume, *spline, {NanPolicy::Kind::empty, 0.0})),
        coefficients(spline->coefficients(volume, Spline::Prefilter::automatic)) {}
};

}  // namespace quincunx

#include "spline/trilinear.h"

#include <array>
#include <cassert>
#include <cmath>

#include "spline/quasi_interpolation.h"

namespace quincunx {
namespace {

/// The samples at a cell's corners, number x + 2y + 4z.
using Corners = std::array<double, 8>;

Corners corners(const Coefficients<double>& c, const glm::ivec3& cell) {
  assert(c.lattice == LatticeKind::cartesian);
  const double* base = c.data.data() + c.number(0, cell);
  Corners f;
  for (int n = 0; n < 8; ++n) f[n] = base[(n & 1) + (n >> 1 & 1) * c.stride_y() + (n >> 2) * c.stride_z()];
  return f;
}

/// The trilinear polynomial at w, the cell's own coordinates.
double value(const Corners& f, double x, double y, double z) {
  const auto mix = [](double a, double b, double t) { return (1.0 - t) * a + t * b; };
  return mix(mix(mix(f[0], f[1], x), mix(f[2], f[3], x), y), mix(mix(f[4], f[5], x), mix(f[6], f[7], x), y), z);
}

/// Differences of the corners along an axis (1, 2 or 4), as corners of a polynomial that does not depend on it.
Corners differences(const Corners& f, int axis) {
  Corners d;
  for (int n = 0; n < 8; ++n) d[n] = f[n | axis] - f[n & ~axis];
  return d;
}

}  // namespace

Jet Trilinear::generator(const glm::dvec3& x) const {
  // Half open like the cells: where the gradient jumps, it is that from above.
  if (glm::any(glm::lessThan(x, glm::dvec3(-1.0))) || glm::any(glm::greaterThanEqual(x, glm::dvec3(1.0)))) return {};
  const glm::dvec3 h = 1.0 - glm::abs(x);
  const glm::dvec3 d = glm::mix(glm::dvec3(1.0), glm::dvec3(-1.0), glm::greaterThanEqual(x, glm::dvec3(0.0)));
  return {h.x * h.y * h.z, {d.x * h.y * h.z, h.x * d.y * h.z, h.x * h.y * d.z}};
}

Jet Trilinear::evaluate(const Coefficients<double>& c, const glm::dvec3& u) const {
  const glm::i64vec3 last = domain_max(LatticeKind::cartesian, c.extents);
  assert(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, glm::dvec3(last))));
  const glm::ivec3 cell = cell_of(u, last);
  const Corners f = corners(c, cell);
  const glm::dvec3 w = u - glm::dvec3(cell);
  Jet jet{value(f, w.x, w.y, w.z), {}};
  for (int a = 0; a < 3; ++a) jet.gradient[a] = value(differences(f, 1 << a), w.x, w.y, w.z);
  return jet;
}

void Trilinear::restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a_,
                                    const glm::dvec3& b_, std::span<double> bernstein) const {
  assert(bernstein.size() == 4);
  // The polar form of xyz-degree (1,1,1) at three points is the mean over which point gives which coordinate.
  const Corners f = corners(c, cell);
  const glm::dvec3 a = a_ - glm::dvec3(cell), b = b_ - glm::dvec3(cell);
  bernstein[0] = value(f, a.x, a.y, a.z);
  bernstein[1] = (value(f, b.x, a.y, a.z) + value(f, a.x, b.y, a.z) + value(f, a.x, a.y, b.z)) / 3.0;
  bernstein[2] = (value(f, a.x, b.y, b.z) + value(f, b.x, a.y, b.z) + value(f, b.x, b.y, a.z)) / 3.0;
  bernstein[3] = value(f, b.x, b.y, b.z);
}

Coefficients<double> Trilinear::coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress) const {
  filter(prefilter);
  return axis_coefficients<double>(volume, lattice(), kIdentityAxisMask, apron(), name(), {}, progress);
}

Coefficients<float> Trilinear::coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit, const Progress& progress) const {
  filter(prefilter);
  return axis_coefficients<float>(volume, lattice(), kIdentityAxisMask, apron(), name(), unit, progress);
}

}  // namespace quincunx

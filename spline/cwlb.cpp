#include "spline/cwlb.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "spline/quasi_interpolation.h"

namespace quincunx {
namespace {

constexpr double kPi = glm::pi<double>();

/// Numbers at a cell's corners, number x + 2y + 4z: a trilinear polynomial on the cell.
using Corners = std::array<double, 8>;

/// The interpolant of a coset on a cell, which is an octant of a cube between 8 samples.
Corners octant(const Coefficients<double>& c, int coset, const glm::ivec3& cell) {
  const glm::ivec3 from_even = cell - coset, half = from_even & 1;
  const double* base = c.data.data() + c.number(coset, glm::i64vec3((from_even - half) / 2));
  Corners f;
  for (int n = 0; n < 8; ++n) f[n] = base[(n & 1) + (n >> 1 & 1) * c.stride_y() + (n >> 2) * c.stride_z()];
  for (int a = 0; a < 3; ++a)
    for (int n = 0; n < 8; ++n) {
      const int bit = 1 << a;
      if (n & bit) continue;
      f[half[a] ? n : n | bit] = 0.5 * (f[n] + f[n | bit]);
    }
  return f;
}

double value(const Corners& f, const glm::dvec3& w) {
  const auto mix = [](double a, double b, double t) { return (1.0 - t) * a + t * b; };
  return mix(mix(mix(f[0], f[1], w.x), mix(f[2], f[3], w.x), w.y), mix(mix(f[4], f[5], w.x), mix(f[6], f[7], w.x), w.y), w.z);
}

/// The derivative along an axis, which does not depend on that coordinate.
Corners derivative(const Corners& f, int axis) {
  Corners d;
  for (int n = 0; n < 8; ++n) d[n] = f[n | 1 << axis] - f[n & ~(1 << axis)];
  return d;
}
Corners derivative(const Corners& f, const glm::dvec3& d) {
  Corners sum{};
  for (int a = 0; a < 3; ++a) {
    const Corners along = derivative(f, a);
    for (int n = 0; n < 8; ++n) sum[n] += d[a] * along[n];
  }
  return sum;
}

Corners difference(const Corners& f, const Corners& g) {
  Corners d;
  for (int n = 0; n < 8; ++n) d[n] = f[n] - g[n];
  return d;
}

double largest(const Corners& f) {
  double most = 0.0;
  for (const double x : f) most = std::max(most, std::abs(x));
  return most;
}

/// The weight of the even coset at x from one of its points, and its gradient.
Jet weight(const glm::dvec3& x) {
  const glm::dvec3 c = glm::cos(kPi * x);
  return {0.5 + (c.x + c.y + c.z) / 6.0, -kPi / 6.0 * glm::sin(kPi * x)};
}

}  // namespace

Jet Cwlb::generator(const glm::dvec3& x) const {
  // Half open like the cells: where the gradient jumps, it is that from above.
  if (glm::any(glm::lessThan(x, glm::dvec3(-2.0))) || glm::any(glm::greaterThanEqual(x, glm::dvec3(2.0)))) return {};
  const glm::dvec3 h = 1.0 - 0.5 * glm::abs(x);
  const glm::dvec3 d = glm::mix(glm::dvec3(0.5), glm::dvec3(-0.5), glm::greaterThanEqual(x, glm::dvec3(0.0)));
  const double linear = h.x * h.y * h.z;
  const Jet a = weight(x);
  return {a.value * linear, a.value * glm::dvec3(d.x * h.y * h.z, h.x * d.y * h.z, h.x * h.y * d.z) + linear * a.gradient};
}

Jet Cwlb::evaluate(const Coefficients<double>& c, const glm::dvec3& u) const {
  const glm::i64vec3 last = domain_max(LatticeKind::bcc, c.extents);
  assert(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, glm::dvec3(last))));
  return evaluate_piece(c, cell_of(u, last), u);
}

Jet Cwlb::evaluate_piece(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& u) const {
  assert(c.lattice == LatticeKind::bcc && c.apron >= 1);
  const Corners even = octant(c, 0, cell), odd = octant(c, 1, cell);
  // cos(pi u) of the whole part of u is a sign.
  const glm::dvec3 w = u - glm::dvec3(cell), sign(1 - 2 * (cell & 1));
  const glm::dvec3 cosine = sign * glm::cos(kPi * w), sine = sign * glm::sin(kPi * w);
  const double a = 0.5 + (cosine.x + cosine.y + cosine.z) / 6.0, apart = value(even, w) - value(odd, w);
  Jet jet{value(odd, w) + a * apart, -kPi / 6.0 * apart * sine};
  for (int i = 0; i < 3; ++i) {
    const double slope = value(derivative(odd, i), w);
    jet.gradient[i] += slope + a * (value(derivative(even, i), w) - slope);
  }
  return jet;
}

// With D = f0 - f1 and ' along d, s'' = a f0'' + (1 - a) f1'' + 2 a' D' + a'' D. On the cell f0, f1, and so D, D' and f0'', f1'' too, are
// polynomials of degree 1 in each coordinate, largest at its corners; 0 <= a <= 1, |a'| <= pi/6 sum |d_i|, |a''| <= pi^2/6 sum d_i^2.
double Cwlb::curvature(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& d) const {
  const Corners even = octant(c, 0, cell), odd = octant(c, 1, cell), apart = difference(even, odd);
  const double bend = std::max(largest(derivative(derivative(even, d), d)), largest(derivative(derivative(odd, d), d)));
  const glm::dvec3 size = glm::abs(d);
  return bend + kPi / 3.0 * (size.x + size.y + size.z) * largest(derivative(apart, d)) + kPi * kPi / 6.0 * glm::dot(d, d) * largest(apart);
}

Coefficients<double> Cwlb::coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress) const {
  filter(prefilter);
  return bcc_coefficients<double>(volume, kIdentityMask, apron(), name(), {}, progress);
}

Coefficients<float> Cwlb::coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit, const Progress& progress) const {
  filter(prefilter);
  return bcc_coefficients<float>(volume, kIdentityMask, apron(), name(), unit, progress);
}

}  // namespace quincunx

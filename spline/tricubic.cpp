#include "spline/tricubic.h"

#include <array>
#include <cassert>
#include <cmath>

#include "spline/quasi_interpolation.h"

namespace quincunx {
namespace {

using Four = std::array<double, 4>;

/// The cubic B-spline and its derivative at x, by its pieces on 1 <= |x| <= 2 and |x| <= 1; every term is positive.
struct CubicJet {
  double value, derivative;
};
CubicJet cubic(double x) {
  const double a = std::abs(x), sign = x < 0.0 ? -1.0 : 1.0;
  if (a >= 2.0) return {0.0, 0.0};
  if (a >= 1.0) {
    const double v = 2.0 - a;
    return {v * v * v / 6.0, sign * -0.5 * v * v};
  }
  const double v = 1.0 - a;
  return {(1.0 + 3.0 * v * (1.0 + v * a)) / 6.0, sign * a * (1.5 * a - 2.0)};
}

/// The weights of the samples at -1, 0, 1, 2 for the point w of the cell [0,1], and their derivatives.
struct Weights {
  Four value, derivative;

  explicit Weights(double w) {
    for (int i = 0; i < 4; ++i) {
      const CubicJet jet = cubic(w - (i - 1));
      value[i] = jet.value, derivative[i] = jet.derivative;
    }
  }
};

/// Where the 64 samples of a cell are.
struct Stencil {
  const double* first;  ///< the sample one before the cell's lower corner along every axis
  std::int64_t stride_y, stride_z;

  Stencil(const Coefficients<double>& c, const glm::ivec3& cell)
      : first(c.data.data() + c.number(0, glm::i64vec3(cell) - std::int64_t(1))),
        stride_y(c.stride_y()),
        stride_z(c.stride_z()) {
    assert(c.lattice == LatticeKind::cartesian && c.apron >= 1);
  }
  const double* row(int j, int k) const { return first + j * stride_y + k * stride_z; }
};

double dot(const Four& weights, const double* samples) {
  return (weights[0] * samples[0] + weights[1] * samples[1]) + (weights[2] * samples[2] + weights[3] * samples[3]);
}

/// Bernstein coefficients on [0,1] of the pieces there of the B-splines centred at -1, 0, 1, 2.
constexpr double kPieces[4][4] = {{1.0 / 6.0, 0.0, 0.0, 0.0},
                                  {4.0 / 6.0, 4.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0},
                                  {1.0 / 6.0, 2.0 / 6.0, 4.0 / 6.0, 4.0 / 6.0},
                                  {0.0, 0.0, 0.0, 1.0 / 6.0}};

/// The polar form of the cubic of Bernstein coefficients b on [0,1].
double polar(const double* b, double r, double s, double t) {
  const auto mix = [](double x, double y, double p) { return (1.0 - p) * x + p * y; };
  const double b0 = mix(b[0], b[1], r), b1 = mix(b[1], b[2], r), b2 = mix(b[2], b[3], r);
  return mix(mix(b0, b1, s), mix(b1, b2, s), t);
}

/// For each sample along an axis its weight as a polynomial along the segment from a to b (the cell's own coordinate), in
/// scaled Bernstein form: coefficient m times binomial(3, m), so that products are convolutions.
std::array<Four, 4> weights_along(double a, double b) {
  std::array<Four, 4> weights;
  for (int i = 0; i < 4; ++i) {
    const double* piece = kPieces[i];
    weights[i] = {polar(piece, a, a, a), 3.0 * polar(piece, a, a, b), 3.0 * polar(piece, a, b, b),
                  polar(piece, b, b, b)};
  }
  return weights;
}

/// sum += p q, polynomials in scaled Bernstein form of degree N - 1 and 3.
template <std::size_t N>
void add_product(const std::array<double, N>& p, const Four& q, std::array<double, N + 3>& sum) {
  for (std::size_t n = 0; n < N; ++n)
    for (std::size_t m = 0; m < 4; ++m) sum[n + m] += p[n] * q[m];
}

const AxisMask& mask_of(const Spline::Filter& filter) {
  return filter.kind == Spline::Prefilter::none ? kIdentityAxisMask : kCubicAxisMask;
}

}  // namespace

Jet Tricubic::generator(const glm::dvec3& x) const {
  const CubicJet a = cubic(x.x), b = cubic(x.y), c = cubic(x.z);
  return {a.value * b.value * c.value,
          {a.derivative * b.value * c.value, a.value * b.derivative * c.value, a.value * b.value * c.derivative}};
}

Jet Tricubic::evaluate(const Coefficients<double>& c, const glm::dvec3& u) const {
  const glm::i64vec3 last = domain_max(LatticeKind::cartesian, c.extents);
  assert(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, glm::dvec3(last))));
  const glm::ivec3 cell = cell_of(u, last);
  const Stencil stencil(c, cell);
  const glm::dvec3 w = u - glm::dvec3(cell);
  const Weights x(w.x), y(w.y), z(w.z);
  // Sums over i, then j, of every row and plane: values, and derivatives along x and y.
  Jet jet;
  for (int k = 0; k < 4; ++k) {
    Four along_x, slope_x;
    for (int j = 0; j < 4; ++j) {
      along_x[j] = dot(x.value, stencil.row(j, k));
      slope_x[j] = dot(x.derivative, stencil.row(j, k));
    }
    const double plane = dot(y.value, along_x.data());
    jet.value += z.value[k] * plane;
    jet.gradient.x += z.value[k] * dot(y.value, slope_x.data());
    jet.gradient.y += z.value[k] * dot(y.derivative, along_x.data());
    jet.gradient.z += z.derivative[k] * plane;
  }
  return jet;
}

void Tricubic::restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                                   const glm::dvec3& b, std::span<double> bernstein) const {
  assert(bernstein.size() == 10);
  const Stencil stencil(c, cell);
  const glm::dvec3 from = a - glm::dvec3(cell), to = b - glm::dvec3(cell);
  const std::array<Four, 4> x = weights_along(from.x, to.x), y = weights_along(from.y, to.y),
                            z = weights_along(from.z, to.z);
  // s = sum_k Z_k sum_j Y_j sum_i c_ijk X_i: cubics, sextics, then degree 9.
  std::array<double, 10> sum{};
  for (int k = 0; k < 4; ++k) {
    std::array<double, 7> plane{};
    for (int j = 0; j < 4; ++j) {
      const double* samples = stencil.row(j, k);
      Four row{};
      for (int i = 0; i < 4; ++i)
        for (int m = 0; m < 4; ++m) row[m] += samples[i] * x[i][m];
      add_product(row, y[j], plane);
    }
    add_product(plane, z[k], sum);
  }
  constexpr double kBinomials[10] = {1, 9, 36, 84, 126, 126, 84, 36, 9, 1};
  for (int m = 0; m < 10; ++m) bernstein[m] = sum[m] / kBinomials[m];
}

Coefficients<double> Tricubic::coefficients(const Volume& volume, Prefilter prefilter,
                                            const Progress& progress) const {
  return cartesian_coefficients<double>(volume, mask_of(filter(prefilter)), apron(), name(), {}, progress);
}

Coefficients<float> Tricubic::coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit, const Progress& progress) const {
  return cartesian_coefficients<float>(volume, mask_of(filter(prefilter)), apron(), name(), unit, progress);
}

}  // namespace quincunx

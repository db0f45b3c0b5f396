// Products of functions of one variable along the axes, on the piece that a cube of samples makes: what all such splines compute.
#pragma once

#include <array>
#include <cstdint>

#include "spline/spline.h"

namespace quincunx {

/// A function of one variable and its derivative.
struct AxisJet {
  double value = 0.0, derivative = 0.0;
};

// A basis says what a sample weighs along an axis, samples being 1 apart:
//   kTaps        how many samples reach a piece; its polynomials have the degree kTaps - 1
//   kFirst       where the first of them stands in the piece's own coordinate, which is in [0,1]
//   kBernstein   of each of these samples the Bernstein coefficients of its weight on [0,1]
//   at(x)        the weight at x from the sample, and its derivative

/// The samples from `first` on that reach one piece, kTaps along each axis.
template <class Basis>
struct TensorPiece {
  static constexpr int kTaps = Basis::kTaps;
  static constexpr int kDegree = kTaps - 1;
  using Taps = std::array<double, kTaps>;
  /// A polynomial along a segment, in scaled Bernstein form: coefficient m times binomial(degree, m), so that products are convolutions.
  using Segment = std::array<double, 3 * kDegree + 1>;

  const double* first;
  std::int64_t stride_y, stride_z;

  /// The samples of coset `coset` from `index` on.
  TensorPiece(const Coefficients<double>& c, int coset, const glm::i64vec3& index)
      : first(c.data.data() + c.number(coset, index)), stride_y(c.stride_y()), stride_z(c.stride_z()) {}

  /// Value and gradient at w in [0,1]^3.
  Jet jet(const glm::dvec3& w) const;
  /// sum += the polynomial from `from` to `to`, both in the piece's own coordinates.
  void add_segment(const glm::dvec3& from, const glm::dvec3& to, Segment& sum) const;

 private:
  const double* row(int j, int k) const { return first + j * stride_y + k * stride_z; }
};

/// The product of basis functions at x.
template <class Basis>
Jet tensor_generator(const glm::dvec3& x) {
  const AxisJet a = Basis::at(x.x), b = Basis::at(x.y), c = Basis::at(x.z);
  return {a.value * b.value * c.value, {a.derivative * b.value * c.value, a.value * b.derivative * c.value, a.value * b.value * c.derivative}};
}

namespace detail {

constexpr double binomial(int n, int k) { return k == 0 ? 1.0 : binomial(n, k - 1) * (n - k + 1) / k; }

/// The weights of a piece's samples at w, and their derivatives.
template <class Basis>
struct PointWeights {
  std::array<double, Basis::kTaps> value, derivative;

  explicit PointWeights(double w) {
    for (int i = 0; i < Basis::kTaps; ++i) {
      const AxisJet jet = Basis::at(w - (i + Basis::kFirst));
      value[i] = jet.value, derivative[i] = jet.derivative;
    }
  }
};

/// Sums of a few terms, in pairs.
inline double dot(const std::array<double, 3>& w, const double* s) { return (w[0] * s[0] + w[1] * s[1]) + w[2] * s[2]; }
inline double dot(const std::array<double, 4>& w, const double* s) { return (w[0] * s[0] + w[1] * s[1]) + (w[2] * s[2] + w[3] * s[3]); }

/// The polar form at n - m times a and m times b of the polynomial with these Bernstein coefficients on [0,1], n = N - 1.
template <std::size_t N>
double polar(std::array<double, N> p, std::size_t m, double a, double b) {
  for (std::size_t left = N - 1; left > 0; --left) {
    const double t = left > m ? a : b;
    for (std::size_t i = 0; i < left; ++i) p[i] = (1.0 - t) * p[i] + t * p[i + 1];
  }
  return p[0];
}

/// For each sample along an axis its weight as a polynomial from a to b, in scaled Bernstein form.
template <class Basis>
std::array<std::array<double, Basis::kTaps>, Basis::kTaps> segment_weights(double a, double b) {
  constexpr int degree = Basis::kTaps - 1;
  std::array<std::array<double, Basis::kTaps>, Basis::kTaps> weights;
  for (int i = 0; i <= degree; ++i)
    for (int m = 0; m <= degree; ++m) weights[i][m] = binomial(degree, m) * polar(Basis::kBernstein[i], std::size_t(m), a, b);
  return weights;
}

/// sum += p q, polynomials in scaled Bernstein form.
template <std::size_t M, std::size_t N>
void add_product(const std::array<double, M>& p, const std::array<double, N>& q, std::array<double, M + N - 1>& sum) {
  for (std::size_t m = 0; m < M; ++m)
    for (std::size_t n = 0; n < N; ++n) sum[m + n] += p[m] * q[n];
}

}  // namespace detail

template <class Basis>
Jet TensorPiece<Basis>::jet(const glm::dvec3& w) const {
  const detail::PointWeights<Basis> x(w.x), y(w.y), z(w.z);
  // Sums over i, then j, of every row and plane: values, and derivatives along x and y.
  Jet jet;
  for (int k = 0; k < kTaps; ++k) {
    Taps along_x, slope_x;
    for (int j = 0; j < kTaps; ++j) {
      along_x[j] = detail::dot(x.value, row(j, k));
      slope_x[j] = detail::dot(x.derivative, row(j, k));
    }
    const double plane = detail::dot(y.value, along_x.data());
    jet.value += z.value[k] * plane;
    jet.gradient.x += z.value[k] * detail::dot(y.value, slope_x.data());
    jet.gradient.y += z.value[k] * detail::dot(y.derivative, along_x.data());
    jet.gradient.z += z.derivative[k] * plane;
  }
  return jet;
}

template <class Basis>
void TensorPiece<Basis>::add_segment(const glm::dvec3& from, const glm::dvec3& to, Segment& sum) const {
  const auto x = detail::segment_weights<Basis>(from.x, to.x), y = detail::segment_weights<Basis>(from.y, to.y),
             z = detail::segment_weights<Basis>(from.z, to.z);
  // sum_k Z_k sum_j Y_j sum_i c_ijk X_i
  for (int k = 0; k < kTaps; ++k) {
    std::array<double, 2 * kDegree + 1> plane{};
    for (int j = 0; j < kTaps; ++j) {
      const double* samples = row(j, k);
      Taps along_x{};
      for (int i = 0; i < kTaps; ++i)
        for (int m = 0; m < kTaps; ++m) along_x[m] += samples[i] * x[i][m];
      detail::add_product(along_x, y[j], plane);
    }
    detail::add_product(plane, z[k], sum);
  }
}

}  // namespace quincunx

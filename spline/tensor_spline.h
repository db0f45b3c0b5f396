// Splines on the Cartesian lattice whose generator is a product along the axes.
#pragma once

#include <algorithm>
#include <cassert>

#include "spline/interpolation.h"
#include "spline/quasi_interpolation.h"
#include "spline/tensor_piece.h"

namespace quincunx {

/// The spline of a basis (tensor_piece.h), which also has
///   kName, kShader   its name and its twin
///   kFilters         Spline::filters()
///   kFir             the mask of Prefilter::fir
///   kInterpolation   that of Prefilter::iir, where there is one
/// kTaps^3 samples reach a piece, which has degree 3 (kTaps - 1) along a ray. Where kTaps is even, knots are at the samples and a cell
/// is one piece; where it is odd, they are in the middle between samples, and x, y, z = 1/2 cut a cell into eight.
template <class Basis>
class TensorSpline final : public Spline {
 public:
  std::string_view name() const override { return Basis::kName; }
  LatticeKind lattice() const override { return LatticeKind::cartesian; }
  int degree() const override { return 3 * Piece::kDegree; }
  int apron() const override { return 1; }
  std::span<const Filter> filters() const override { return Basis::kFilters; }
  std::string_view shader() const override { return Basis::kShader; }

  Jet generator(const glm::dvec3& x) const override { return tensor_generator<Basis>(x); }
  Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const override;
  void split(const glm::ivec3& cell, const glm::dvec3& o, const glm::dvec3& d, double t0, double t1, std::vector<double>& t) const override;
  void restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a, const glm::dvec3& b,
                           std::span<double> bernstein) const override;
  Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress = {}) const override {
    return made<double>(volume, prefilter, {}, progress);
  }
  Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                         const Progress& progress = {}) const override {
    return made<float>(volume, prefilter, unit, progress);
  }

 private:
  using Piece = TensorPiece<Basis>;
  static constexpr bool kCut = Basis::kTaps % 2 == 1;

  /// Where the own coordinates of the piece of `cell` that holds u begin.
  static glm::dvec3 origin(const glm::ivec3& cell, const glm::dvec3& u) {
    const glm::dvec3 low(cell);
    if constexpr (!kCut) return low;
    return low + glm::mix(glm::dvec3(-0.5), glm::dvec3(0.5), glm::greaterThanEqual(u, low + 0.5));
  }
  static Piece piece(const Coefficients<double>& c, const glm::dvec3& origin) {
    assert(c.lattice == LatticeKind::cartesian && c.apron >= 1);
    return {c, 0, glm::i64vec3(origin + double(Basis::kFirst))};
  }

  template <class T>
  Coefficients<T> made(const Volume& volume, Prefilter prefilter, const ValueUnit& unit, const Progress& progress) const {
    const Prefilter kind = filter(prefilter).kind;
    if constexpr (requires { Basis::kInterpolation; })
      if (kind == Prefilter::iir) return interpolating_coefficients<T>(volume, Basis::kInterpolation, apron(), name(), unit, progress);
    const AxisMask& mask = kind == Prefilter::none ? kIdentityAxisMask : Basis::kFir;
    return axis_coefficients<T>(volume, lattice(), mask, apron(), name(), unit, progress);
  }
};

template <class Basis>
Jet TensorSpline<Basis>::evaluate(const Coefficients<double>& c, const glm::dvec3& u) const {
  const glm::i64vec3 last = domain_max(LatticeKind::cartesian, c.extents);
  assert(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, glm::dvec3(last))));
  const glm::dvec3 from = origin(cell_of(u, last), u);
  return piece(c, from).jet(u - from);
}

template <class Basis>
void TensorSpline<Basis>::split(const glm::ivec3& cell, const glm::dvec3& o, const glm::dvec3& d, double t0, double t1,
                                std::vector<double>& t) const {
  if constexpr (!kCut) return;
  const auto first = std::ptrdiff_t(t.size());
  for (int a = 0; a < 3; ++a) {
    const double crossing = (cell[a] + 0.5 - o[a]) / d[a];  // not finite where the ray keeps to one side
    if (crossing > t0 && crossing < t1) t.push_back(crossing);
  }
  std::sort(t.begin() + first, t.end());
  t.erase(std::unique(t.begin() + first, t.end()), t.end());
}

template <class Basis>
void TensorSpline<Basis>::restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a, const glm::dvec3& b,
                                              std::span<double> bernstein) const {
  assert(bernstein.size() == std::size_t(degree()) + 1);
  const glm::dvec3 from = origin(cell, 0.5 * (a + b));
  typename Piece::Segment sum{};
  piece(c, from).add_segment(a - from, b - from, sum);
  for (int m = 0; m <= degree(); ++m) bernstein[std::size_t(m)] = sum[std::size_t(m)] / detail::binomial(degree(), m);
}

}  // namespace quincunx

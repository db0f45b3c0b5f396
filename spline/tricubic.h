// The tricubic B-spline on the Cartesian lattice.
#pragma once

#include "spline/spline.h"

namespace quincunx {

/// The product of centred cubic B-splines along the axes: C2, 64 samples reach any cell, of degree 9 along a ray. With
/// quasi-interpolation (-1/6, 4/3, -1/6 along each axis) of approximation order 4, without of order 2.
class Tricubic final : public Spline {
 public:
  std::string_view name() const override { return "tricubic"; }
  LatticeKind lattice() const override { return LatticeKind::cartesian; }
  int degree() const override { return 9; }
  int apron() const override { return 1; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "tricubic.glsl"; }

  Jet generator(const glm::dvec3& x) const override;
  Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const override;
  /// A cell is one piece: nothing to append.
  void split(const glm::ivec3&, const glm::dvec3&, const glm::dvec3&, double, double,
             std::vector<double>&) const override {}
  void restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                           const glm::dvec3& b, std::span<double> bernstein) const override;
  Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter,
                                    const Progress& progress = {}) const override;
  Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                         const Progress& progress = {}) const override;

 private:
  static constexpr Filter kFilters[] = {{Prefilter::fir, 1, 125.0 / 27.0, 4}, {Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

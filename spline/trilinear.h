// Trilinear interpolation on the Cartesian lattice.
#pragma once

#include "spline/spline.h"

namespace quincunx {

/// The product of linear B-splines along the axes: in each cell the one polynomial of degree 1 in each coordinate that
/// takes the samples at its 8 corners. Continuous, not smooth; a cubic along a ray; of approximation order 2.
/// On a face between cells the gradient is that of the upper cell, on the domain's far border of the last one.
class Trilinear final : public Spline {
 public:
  std::string_view name() const override { return "trilinear"; }
  LatticeKind lattice() const override { return LatticeKind::cartesian; }
  int degree() const override { return 3; }
  int apron() const override { return 0; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "trilinear.glsl"; }

  Jet generator(const glm::dvec3& x) const override;
  Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const override;
  /// A cell is one piece: nothing to append.
  void split(const glm::ivec3&, const glm::dvec3&, const glm::dvec3&, double, double,
             std::vector<double>&) const override {}
  void restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                           const glm::dvec3& b, std::span<double> bernstein) const override;
  /// The samples: they are interpolated.
  Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter,
                                    const Progress& progress = {}) const override;
  Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                         const Progress& progress = {}) const override;

 private:
  static constexpr Filter kFilters[] = {{Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

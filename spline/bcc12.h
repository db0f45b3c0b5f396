// Tricubic B-splines on the two cosets of the BCC lattice.
//
// B. Csebfalvi, M. Hadwiger, Prefiltered B-spline reconstruction for hardware-accelerated rendering of optimally sampled volumetric data, Vision,
// Modeling, and Visualization 2006; as a quasi-interpolation of order 4: B. Csebfalvi, An evaluation of prefiltered B-spline reconstruction for
// quasi-interpolation on the body-centered cubic lattice, IEEE Transactions on Visualization and Computer Graphics 16, 2010,
// DOI 10.1109/TVCG.2009.87, which also says why no prefilter makes it interpolate.
#pragma once

#include "spline/spline.h"

namespace quincunx {

/// The mean of the tricubic B-splines of either coset, at spacing 2: the generator is half the product of centred cubic B-splines of x/2 along
/// the axes. C2, 128 samples reach any cell, a cell is one piece of degree 9 along a ray. With quasi-interpolation of each coset
/// (-1/6, 4/3, -1/6 along each axis) of approximation order 4, without of order 2.
class Bcc12 final : public Spline {
 public:
  std::string_view name() const override { return "bcc12"; }
  LatticeKind lattice() const override { return LatticeKind::bcc; }
  int degree() const override { return 9; }
  int apron() const override { return 2; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "bcc12.glsl"; }

  Jet generator(const glm::dvec3& x) const override;
  Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const override;
  /// A cell is one piece: nothing to append.
  void split(const glm::ivec3&, const glm::dvec3&, const glm::dvec3&, double, double, std::vector<double>&) const override {}
  void restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a, const glm::dvec3& b,
                           std::span<double> bernstein) const override;
  Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress = {}) const override;
  Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                         const Progress& progress = {}) const override;

 private:
  static constexpr Filter kFilters[] = {{Prefilter::fir, 1, 125.0 / 27.0, 4}, {Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

// The cosine-weighted linear B-spline on the BCC lattice.
//
// B. Csebfalvi, Cosine-weighted B-spline interpolation: a fast and high-quality reconstruction scheme for the body-centered cubic
// lattice, IEEE Transactions on Visualization and Computer Graphics 19(9), 2013, DOI 10.1109/TVCG.2013.7. docs/splines.md has the mathematics.
#pragma once

#include "spline/spline.h"

namespace quincunx {

/// The trilinear interpolants f0, f1 of the two cosets, mixed by a weight that is 1 at even points and 0 at odd ones:
///   s = a f0 + (1 - a) f1,   a(u) = 1/2 + (cos(pi x) + cos(pi y) + cos(pi z)) / 6,
/// the sum of shifts of M(x) = a(x) L(x/2), L the product of 1 - |x_i|. Interpolates; 16 samples reach a cell, which is one smooth piece and no
/// polynomial. Continuous, not smooth; of approximation order 2. On a face between cells the gradient is that of the upper cell, on the domain's
/// far border of the last one.
class Cwlb final : public Spline {
 public:
  std::string_view name() const override { return "cwlb"; }
  LatticeKind lattice() const override { return LatticeKind::bcc; }
  bool polynomial() const override { return false; }
  int degree() const override { return 0; }  // nobody asks
  int apron() const override { return 1; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "cwlb.glsl"; }

  Jet generator(const glm::dvec3& x) const override;
  Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const override;
  Jet evaluate_piece(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& u) const override;
  double curvature(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& d) const override;
  void split(const glm::ivec3&, const glm::dvec3&, const glm::dvec3&, double, double, std::vector<double>&) const override {}
  void restrict_to_segment(const Coefficients<double>&, const glm::ivec3&, const glm::dvec3&, const glm::dvec3&, std::span<double>) const override {}
  /// The samples: they are interpolated.
  Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress = {}) const override;
  Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                         const Progress& progress = {}) const override;

 private:
  static constexpr Filter kFilters[] = {{Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

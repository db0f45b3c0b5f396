// The quartic box spline of seven directions on the BCC lattice.
//
// M. Kim, Quartic box-spline reconstruction on the BCC lattice, IEEE Transactions on Visualization and Computer
// Graphics, 2013. docs/splines.md has the mathematics and where we depart from the paper.
#pragma once

#include "spline/quartic_tetrahedron.h"
#include "spline/spline.h"
#include "spline/tetrahedron.h"

namespace quincunx {

/// M7 = 4 times the centred box spline of 2e1, 2e2, 2e3, (-1,1,1), (1,-1,1), (1,1,-1), (-1,-1,-1): quartic, C2, 30
/// samples reach any tetrahedron. With quasi-interpolation of approximation order 4, without of order 2.
class Bcc7 final : public Spline {
 public:
  std::string_view name() const override { return "bcc7"; }
  LatticeKind lattice() const override { return LatticeKind::bcc; }
  int degree() const override { return 4; }
  int apron() const override { return 1; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "bcc7.glsl"; }

  Jet generator(const glm::dvec3& x) const override;
  Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const override;
  void split(const glm::ivec3& cell, const glm::dvec3& o, const glm::dvec3& d, double t0, double t1,
             std::vector<double>& t) const override;
  void restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                           const glm::dvec3& b, std::span<double> bernstein) const override;
  Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter,
                                    const Progress& progress = {}) const override;
  Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                         const Progress& progress = {}) const override;

  /// The Bernstein coefficients of the spline on a tetrahedron of the domain: c convolved with the net
  /// (bcc7_net.h), by exact integer weights in one fixed order and one scaling.
  static QuarticNet bernstein(const Coefficients<double>& c, const Tetrahedron& tetrahedron);

 private:
  static constexpr Filter kFilters[] = {{Prefilter::fir, 1, 13.0 / 6.0, 4}, {Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

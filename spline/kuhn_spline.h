// Box splines of the BCC lattice: one polynomial on each Kuhn tetrahedron of a cell.
#pragma once

#include "spline/spline.h"
#include "spline/tetrahedron.h"
#include "spline/tetrahedron_polynomial.h"

namespace quincunx {

/// A spline whose pieces of total degree Degree are cut by the knot planes x +- y, y +- z, x +- z even (and integer x, y, z): on a
/// tetrahedron of spline/tetrahedron.h its Bernstein coefficients are the samples convolved with the generator's net (spline/box_net.h).
/// On a knot plane where the gradient jumps, it is that of the tetrahedron that `locate` finds.
///
/// `Shape` is that of one spline, complete in its .cpp alone:
///   static constexpr const auto& net     its BoxNet, of that degree
///   static constexpr int samples         how many reach a tetrahedron
///   static constexpr int apron
///   static constexpr BccMask mask        of its prefilter
template <int Degree, class Shape>
class KuhnSpline : public Spline {
 public:
  LatticeKind lattice() const final { return LatticeKind::bcc; }
  int degree() const final { return Degree; }

  Jet generator(const glm::dvec3& x) const final;
  Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const final;
  void split(const glm::ivec3& cell, const glm::dvec3& o, const glm::dvec3& d, double t0, double t1,
             std::vector<double>& t) const final;
  void restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                           const glm::dvec3& b, std::span<double> bernstein) const final;
  Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter,
                                    const Progress& progress = {}) const final;
  Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                         const Progress& progress = {}) const final;

  /// The Bernstein coefficients of the spline on a tetrahedron of the domain: c convolved with the net, by exact integer weights in
  /// one fixed order and one scaling.
  static TetrahedronNet<Degree> bernstein(const Coefficients<double>& c, const Tetrahedron& tetrahedron);
};

}  // namespace quincunx

// The quartic box spline of seven directions on the BCC lattice.
//
// M. Kim, Quartic box-spline reconstruction on the BCC lattice, IEEE Transactions on Visualization and Computer
// Graphics, 2013. docs/splines.md has the mathematics and where we depart from the paper.
#pragma once

#include "spline/kuhn_spline.h"

namespace quincunx {

struct Bcc7Shape;
extern template class KuhnSpline<4, Bcc7Shape>;

/// M7 = 4 times the centred box spline of 2e1, 2e2, 2e3, (-1,1,1), (1,-1,1), (1,1,-1), (-1,-1,-1): quartic, C2, 30
/// samples reach any tetrahedron. With quasi-interpolation of approximation order 4, without of order 2.
class Bcc7 final : public KuhnSpline<4, Bcc7Shape> {
 public:
  std::string_view name() const override { return "bcc7"; }
  int apron() const override { return 1; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "bcc7.glsl"; }

 private:
  static constexpr Filter kFilters[] = {{Prefilter::fir, 1, 13.0 / 6.0, 4}, {Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

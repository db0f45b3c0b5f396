// The linear box spline of four directions on the BCC lattice.
//
// A. Entezari, D. Van De Ville, T. Moeller, Practical box splines for reconstruction on the body centered cubic lattice, IEEE Transactions
// on Visualization and Computer Graphics 14(2), 2008, DOI 10.1109/TVCG.2007.70429. docs/splines.md has the mathematics.
#pragma once

#include "spline/kuhn_spline.h"

namespace quincunx {

struct Bcc4Shape;
extern template class KuhnSpline<1, Bcc4Shape>;

/// M4 = 4 times the centred box spline of (-1,1,1), (1,-1,1), (1,1,-1), (-1,-1,-1): linear, C0, interpolating, of approximation order 2.
/// 4 samples reach any tetrahedron: v0 and v3 are samples, v1 and v2 the means of v0 and the next even point, v3 and the next odd one.
/// On a knot plane the gradient is that from above (`locate`), on the domain's far border that of the last cell.
class Bcc4 final : public KuhnSpline<1, Bcc4Shape> {
 public:
  std::string_view name() const override { return "bcc4"; }
  int apron() const override { return 1; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "bcc4.glsl"; }

 private:
  static constexpr Filter kFilters[] = {{Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

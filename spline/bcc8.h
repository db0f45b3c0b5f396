// The quintic box spline of four directions, each twice, on the BCC lattice.
//
// A. Entezari, D. Van De Ville, T. Moeller, Practical box splines for reconstruction on the body centered cubic lattice, IEEE Transactions
// on Visualization and Computer Graphics 14(2), 2008, DOI 10.1109/TVCG.2007.70429. docs/splines.md has the mathematics.
#pragma once

#include "spline/kuhn_spline.h"

namespace quincunx {

struct Bcc8Shape;
extern template class KuhnSpline<5, Bcc8Shape>;

/// M8 = 4 times the centred box spline of (-1,1,1), (1,-1,1), (1,1,-1), (-1,-1,-1), each twice: quintic, C2, 32 samples reach any
/// tetrahedron, two of them 3 and 4 lattice units from it along an axis. With quasi-interpolation of approximation order 4, without of
/// order 2.
class Bcc8 final : public KuhnSpline<5, Bcc8Shape> {
 public:
  std::string_view name() const override { return "bcc8"; }
  int apron() const override { return 2; }
  std::span<const Filter> filters() const override { return kFilters; }
  std::string_view shader() const override { return "bcc8.glsl"; }

 private:
  static constexpr Filter kFilters[] = {{Prefilter::fir, 1, 7.0 / 3.0, 4}, {Prefilter::none, 0, 1.0, 2}};
};

}  // namespace quincunx

// Where a polynomial in Bernstein form changes sides: isolated by signs, so that none is missed.
#pragma once

#include <span>
#include <vector>

namespace quincunx {

/// The largest degree append_crossings takes.
inline constexpr int kMaxDegree = 15;

/// Appends to `x`, ascending, every place in [0,1] where the polynomial p with the Bernstein coefficients `b` (degree+1
/// of them) passes from p < 0 to p >= 0 or back. p = 0 counts as above: touching 0 from below appends the place twice
/// (there and back), touching it from above appends nothing.
///
/// The number of sign changes in `b` exceeds that of p's roots in (0,1) by an even number (variation diminishing): no
/// change means no root, one change with ends on different sides one root. Anything else is halved (de Casteljau)
/// until decided; an interval of 2^-50 is decided by the signs at hand.
void append_crossings(std::span<const double> b, std::vector<double>& x);

}  // namespace quincunx

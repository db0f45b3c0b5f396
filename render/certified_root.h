// Where a smooth function changes sides: isolated by a bound on its curvature, so that none is missed.
#pragma once

#include <functional>
#include <vector>

namespace quincunx {

/// A function at a place, and its derivative there.
struct ValueAndSlope {
  double value, slope;
};

/// Appends to `t`, ascending, every place in [0, end] where g passes from g < 0 to g >= 0 or back, given |g''| <= `curvature` all over it. `above`
/// says on which side g is taken to be before 0, and afterwards on which it is at the end: where that differs at 0, a crossing is there.
///
/// From a place where g has the value v and the slope p, |g| cannot be 0 within s, the least root of |v| + sign(v) p s - curvature s^2 / 2: the
/// next place is s farther, so none is passed, and roots are approached quadratically. Steps are at least 2^-43, and a crossing is told at the first
/// place behind it: up to that, and to what rounding makes of g. Two crossings closer than that, or within rounding of a tangent, are undecided.
///
/// `rounding`: by how much g may be wrong. Where g is within 4 times that of 0, and its slope within 2^13 times as much, a place cannot be told more exactly
/// than to 2^-13, and steps are at least so long: a ray that runs in the surface would take ten million others a cell. Two more roots within such a
/// step would leave g, with four of them, no larger than its fourth derivative times 2^-52 / 24: within rounding too.
void append_crossings(const std::function<ValueAndSlope(double)>& g, double curvature, double rounding, double end, bool& above, std::vector<double>& t);

}  // namespace quincunx

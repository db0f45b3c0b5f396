// The Catmull-Rom spline along each axis of the Cartesian lattice.
//
// E. Catmull, R. Rom, A class of local interpolating splines, Computer Aided Geometric Design, 1974, 317-326, DOI 10.1016/B978-0-12-079050-0.50020-5;
// as a convolution: R. Keys, Cubic convolution interpolation for digital image processing, 1981, DOI 10.1109/TASSP.1981.1163711, equation 15.
#pragma once

#include <cmath>

#include "spline/tensor_spline.h"

namespace quincunx {

/// Keys' kernel, by its pieces on |x| <= 1 and 1 <= |x| <= 2; negative on the latter.
struct CatmullRomBasis {
  static constexpr std::string_view kName = "catmull-rom", kShader = "catmull-rom.glsl";
  static constexpr int kTaps = 4;
  static constexpr int kFirst = -1;
  static constexpr std::array<double, 4> kBernstein[4] = {
      {0.0, -1.0 / 6.0, 0.0, 0.0}, {1.0, 1.0, 1.0 / 6.0, 0.0}, {0.0, 1.0 / 6.0, 1.0, 1.0}, {0.0, 0.0, -1.0 / 6.0, 0.0}};
  static constexpr AxisMask kFir = kIdentityAxisMask;
  static constexpr Spline::Filter kFilters[] = {{Spline::Prefilter::none, 0, 1.0, 3}};

  static AxisJet at(double x) {
    const double a = std::abs(x), sign = x < 0.0 ? -1.0 : 1.0;
    if (a >= 2.0) return {0.0, 0.0};
    const double v = 2.0 - a;
    if (a >= 1.0) return {0.5 * (1.0 - a) * v * v, sign * -0.5 * v * (4.0 - 3.0 * a)};
    return {1.0 + a * a * (1.5 * a - 2.5), sign * a * (4.5 * a - 5.0)};
  }
};

/// The product of Catmull-Rom splines along the axes: it takes the samples, C1, 64 samples reach any cell, of degree 9 along a ray and of
/// approximation order 3. Between samples it may leave their range, by 1/8 of it along one axis.
using CatmullRom = TensorSpline<CatmullRomBasis>;

}  // namespace quincunx

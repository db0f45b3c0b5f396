// The tricubic B-spline on the Cartesian lattice.
#pragma once

#include <cmath>

#include "spline/tensor_spline.h"

namespace quincunx {

/// The centred cubic B-spline, by its pieces on 1 <= |x| <= 2 and |x| <= 1; every term is positive.
struct CubicBasis {
  static constexpr std::string_view kName = "tricubic", kShader = "tricubic.glsl";
  static constexpr int kTaps = 4;
  static constexpr int kFirst = -1;
  static constexpr std::array<double, 4> kBernstein[4] = {{1.0 / 6.0, 0.0, 0.0, 0.0},
                                                          {4.0 / 6.0, 4.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0},
                                                          {1.0 / 6.0, 2.0 / 6.0, 4.0 / 6.0, 4.0 / 6.0},
                                                          {0.0, 0.0, 0.0, 1.0 / 6.0}};
  static constexpr AxisMask kFir = kCubicAxisMask;
  static constexpr InterpolationMask kInterpolation = kCubicInterpolation;
  static constexpr Spline::Filter kFilters[] = {{Spline::Prefilter::fir, 1, 125.0 / 27.0, 4},
                                                {Spline::Prefilter::iir, kInterpolation.reach, 27.0, 4},
                                                {Spline::Prefilter::none, 0, 1.0, 2}};

  static AxisJet at(double x) {
    const double a = std::abs(x), sign = x < 0.0 ? -1.0 : 1.0;
    if (a >= 2.0) return {0.0, 0.0};
    if (a >= 1.0) {
      const double v = 2.0 - a;
      return {v * v * v / 6.0, sign * -0.5 * v * v};
    }
    const double v = 1.0 - a;
    return {(1.0 + 3.0 * v * (1.0 + v * a)) / 6.0, sign * a * (1.5 * a - 2.0)};
  }
};

/// The product of centred cubic B-splines along the axes: C2, 64 samples reach any cell, of degree 9 along a ray. With
/// quasi-interpolation (-1/6, 4/3, -1/6 along each axis) of approximation order 4, interpolating (iir) of the same, without of order 2.
using Tricubic = TensorSpline<CubicBasis>;

}  // namespace quincunx

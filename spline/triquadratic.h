// The triquadratic B-spline on the Cartesian lattice.
#pragma once

#include <cmath>

#include "spline/tensor_spline.h"

namespace quincunx {

/// The centred quadratic B-spline, by its pieces on 1/2 <= |x| <= 3/2 and |x| <= 1/2. Its knots are in the middle between samples.
struct QuadraticBasis {
  static constexpr std::string_view kName = "triquadratic", kShader = "triquadratic.glsl";
  static constexpr int kTaps = 3;
  static constexpr double kFirst = -0.5;
  static constexpr std::array<double, 3> kBernstein[3] = {{0.5, 0.0, 0.0}, {0.5, 1.0, 0.5}, {0.0, 0.0, 0.5}};
  static constexpr AxisMask kFir = kQuadraticAxisMask;
  static constexpr InterpolationMask kInterpolation = kQuadraticInterpolation;
  static constexpr Spline::Filter kFilters[] = {{Spline::Prefilter::fir, 1, 27.0 / 8.0, 3},
                                                {Spline::Prefilter::iir, kInterpolation.reach, 8.0, 3},
                                                {Spline::Prefilter::none, 0, 1.0, 2}};

  static AxisJet at(double x) {
    const double a = std::abs(x), sign = x < 0.0 ? -1.0 : 1.0;
    if (a >= 1.5) return {0.0, 0.0};
    if (a >= 0.5) {
      const double v = 1.5 - a;
      return {0.5 * v * v, -sign * v};
    }
    return {0.75 - x * x, -2.0 * x};
  }
};

/// The product of centred quadratic B-splines along the axes: C1, 27 samples reach any of a cell's eight pieces, of degree 6 along a ray.
/// With quasi-interpolation (-1/8, 5/4, -1/8 along each axis) of approximation order 3, interpolating (iir) of the same, without of order 2.
using Triquadratic = TensorSpline<QuadraticBasis>;

}  // namespace quincunx

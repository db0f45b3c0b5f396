// Coefficients of the B-splines that take the samples.
//
// M. Unser, A. Aldroubi, M. Eden, B-spline signal processing: part I, theory, IEEE Transactions on Signal Processing 41, 1993,
// DOI 10.1109/78.193220: the inverse of a sampled B-spline is a recursive filter, whose impulse response is const z^|n|. We apply that response as a mask:
// a recursion's rounding depends on where it began, the mask's does not, so that coefficients of a box cut out of a volume are the volume's.
#pragma once

#include <string_view>

#include "lattice/progress.h"
#include "lattice/volume.h"
#include "spline/coefficients.h"

namespace quincunx {

/// The inverse of z -> (z + a + 1/z) / (2 + a) along an axis, of the pole `pole` in (-1,0): weights (1 - pole) / (1 + pole) pole^|n|,
/// left out from where they are below half an ulp of 1.
struct InterpolationMask {
  double pole;
  int reach;    ///< how far the weights go
  double gain;  ///< the sum of their absolute values
};

/// Of cubic B-splines: sqrt(3) - 2, and of quadratic ones: 2 sqrt(2) - 3.
inline constexpr InterpolationMask kCubicInterpolation{-0.26794919243112270647, 28, 3.0};
inline constexpr InterpolationMask kQuadraticInterpolation{-0.17157287525380990240, 21, 2.0};

/// Convolves the samples, extended by clamping, with `mask` along each axis of a Cartesian grid, at the points in range, as
/// axis_coefficients does with its masks of three taps. Constants are kept to the last bit. Beside the result there are 8 bytes a sample at the time.
template <class T>
Coefficients<T> interpolating_coefficients(const Volume& volume, const InterpolationMask& mask, int apron, std::string_view spline,
                                           const ValueUnit& unit, const Progress& progress);

extern template Coefficients<double> interpolating_coefficients(const Volume&, const InterpolationMask&, int, std::string_view,
                                                                const ValueUnit&, const Progress&);
extern template Coefficients<float> interpolating_coefficients(const Volume&, const InterpolationMask&, int, std::string_view,
                                                               const ValueUnit&, const Progress&);

}  // namespace quincunx

// From samples to spline coefficients, on either lattice. A coefficient is computed from the samples about it by the same
// operations wherever it stands, so that the coefficients of a box cut out of a volume, with the samples that they depend
// on, are those of the volume to the last bit.
#pragma once

#include <string_view>

#include "lattice/progress.h"
#include "lattice/volume.h"
#include "spline/coefficients.h"

namespace quincunx {

/// A symmetric mask on a BCC point and its 14 nearest neighbours, integers over one denominator: the point itself,
/// the 6 points at +-2 e_a, the 8 points (+-1,+-1,+-1). Integers keep sums of integer samples exact.
struct BccMask {
  double centre, axial, diagonal, denominator;
};

/// The samples as they are.
inline constexpr BccMask kIdentityMask{1, 0, 0, 1};
/// q7 of bcc7: 19/12 at the centre, -1/24 at the 14 neighbours.
inline constexpr BccMask kBcc7Mask{38, -1, -1, 24};
/// For bcc8: 5/3 at the centre, -1/12 at the 8 points (+-1,+-1,+-1).
inline constexpr BccMask kBcc8Mask{20, 0, -1, 12};

/// A symmetric mask of three taps, integers over one denominator, applied along each axis of a Cartesian grid or of each coset. Where the
/// sides are 0 it must be the identity.
struct AxisMask {
  double side, centre, denominator;
};

/// The samples as they are.
inline constexpr AxisMask kIdentityAxisMask{0, 1, 1};
/// For quadratic B-splines: 5/4 at the centre, -1/8 at either side.
inline constexpr AxisMask kQuadraticAxisMask{-1, 10, 8};
/// For cubic B-splines: 4/3 at the centre, -1/6 at either side.
inline constexpr AxisMask kCubicAxisMask{-1, 8, 6};

/// Convolves the samples, extended by clamping each index of each coset, with `mask` at the points in range, in double;
/// in `unit`, rounded to T once; extends the result by `apron` samples in the same way. `spline` is its user, for errors.
/// Throws InputError where the volume is not BCC, its samples are not as many as its extents say, one is NaN or
/// infinite, or a result does not fit T.
template <class T>
Coefficients<T> bcc_coefficients(const Volume& volume, const BccMask& mask, int apron, std::string_view spline,
                                 const ValueUnit& unit, const Progress& progress);

/// The same of each coset apart along its axes, on the lattice that is told; the apron is one sample wider where an axis of the Cartesian one
/// has one sample (Spline::apron).
template <class T>
Coefficients<T> axis_coefficients(const Volume& volume, LatticeKind lattice, const AxisMask& mask, int apron, std::string_view spline,
                                  const ValueUnit& unit, const Progress& progress);

extern template Coefficients<double> bcc_coefficients(const Volume&, const BccMask&, int, std::string_view, const ValueUnit&,
                                                      const Progress&);
extern template Coefficients<float> bcc_coefficients(const Volume&, const BccMask&, int, std::string_view, const ValueUnit&,
                                                      const Progress&);
extern template Coefficients<double> axis_coefficients(const Volume&, LatticeKind, const AxisMask&, int, std::string_view, const ValueUnit&,
                                                       const Progress&);
extern template Coefficients<float> axis_coefficients(const Volume&, LatticeKind, const AxisMask&, int, std::string_view, const ValueUnit&,
                                                      const Progress&);

}  // namespace quincunx

#include "spline/quasi_interpolation.h"

#include <limits>

#include "spline/convolution.h"

namespace quincunx {
namespace {

/// Convolves row (j,k) of a coset. `out` receives extents.x values; `own` and `diagonal` are scratch of extents.x + 2.
/// Returns whether every value fits T.
template <class T, class S>
bool convolve_row(const SampleRows<S>& source, const BccMask& mask, const ValueUnit& unit, int coset, std::int64_t j, std::int64_t k, T* out,
                  double* own, double* diagonal) {
  const std::int64_t n = source.extents.x;
  const S* centre = source.row(coset, j, k);
  const S *below = source.row(coset, j - 1, k), *above = source.row(coset, j + 1, k);
  const S *behind = source.row(coset, j, k - 1), *before = source.row(coset, j, k + 1);
  // The diagonal neighbours of index i are i + coset - 1 and i + coset of the other coset, along every axis.
  const std::int64_t j0 = j + coset - 1, k0 = k + coset - 1;
  const S *d00 = source.row(1 - coset, j0, k0), *d10 = source.row(1 - coset, j0 + 1, k0);
  const S *d01 = source.row(1 - coset, j0, k0 + 1), *d11 = source.row(1 - coset, j0 + 1, k0 + 1);
  for (std::int64_t i = 0; i < n; ++i) {
    own[1 + i] = centre[i];
    diagonal[1 + i] = (double(d00[i]) + double(d10[i])) + (double(d01[i]) + double(d11[i]));
  }
  extend_row(own + 1, n, 1);
  extend_row(diagonal + 1, n, 1);

  const double inverse = 1.0 / unit.scale;
  double largest = 0.0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double cross = (double(below[i]) + double(above[i])) + (double(behind[i]) + double(before[i]));
    const double axial = cross + (own[i] + own[i + 2]);
    const double diagonals = diagonal[i + coset] + diagonal[i + coset + 1];
    const double value = ((mask.centre * own[i + 1] + mask.axial * axial + mask.diagonal * diagonals) / mask.denominator - unit.offset) * inverse;
    largest = std::max(largest, value < 0.0 ? -value : value);
    out[i] = T(value);
  }
  return largest <= double(std::numeric_limits<T>::max());
}

/// Row (j,k) of a coset convolved along z, then y, then x. `along_z_y` is scratch of extents.x + 2. Returns whether every value
/// fits T.
template <class T, class S>
bool convolve_row(const SampleRows<S>& source, const AxisMask& mask, const ValueUnit& unit, int coset, std::int64_t j, std::int64_t k, T* out,
                  double* along_z_y) {
  const std::int64_t n = source.extents.x;
  const S* rows[3][3];
  for (int b = 0; b < 3; ++b)
    for (int a = 0; a < 3; ++a) rows[b][a] = source.row(coset, j + b - 1, k + a - 1);
  for (std::int64_t i = 0; i < n; ++i) {
    double along_z[3];
    for (int b = 0; b < 3; ++b)
      along_z[b] = mask.centre * double(rows[b][1][i]) + mask.side * (double(rows[b][0][i]) + double(rows[b][2][i]));
    along_z_y[1 + i] = mask.centre * along_z[1] + mask.side * (along_z[0] + along_z[2]);
  }
  extend_row(along_z_y + 1, n, 1);

  const double denominator = mask.denominator * mask.denominator * mask.denominator;
  const double inverse = 1.0 / unit.scale;
  double largest = 0.0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double value =
        ((mask.centre * along_z_y[i + 1] + mask.side * (along_z_y[i] + along_z_y[i + 2])) / denominator - unit.offset) * inverse;
    largest = std::max(largest, value < 0.0 ? -value : value);
    out[i] = T(value);
  }
  return largest <= double(std::numeric_limits<T>::max());
}

}  // namespace

template <class T>
Coefficients<T> bcc_coefficients(const Volume& volume, const BccMask& mask, int apron, std::string_view spline, const ValueUnit& unit,
                                 const Progress& progress) {
  const auto row = [&mask, &unit, n = volume.extents.x](const auto& source, int coset, std::int64_t j, std::int64_t k, T* out,
                                                 double* scratch) {
    return convolve_row(source, mask, unit, coset, j, k, out, scratch, scratch + n + 2);
  };
  return convolve<T>(volume, LatticeKind::bcc, apron, spline, unit, row, progress);
}

template <class T>
Coefficients<T> axis_coefficients(const Volume& volume, LatticeKind lattice, const AxisMask& mask, int apron, std::string_view spline,
                                  const ValueUnit& unit, const Progress& progress) {
  const int wide = lattice == LatticeKind::cartesian ? cartesian_apron(volume.extents, apron) : apron;
  const auto row = [&](const auto& source, int coset, std::int64_t j, std::int64_t k, T* out, double* scratch) {
    if (mask.side != 0.0) return convolve_row(source, mask, unit, coset, j, k, out, scratch);
    const auto* from = source.row(coset, j, k);
    for (std::int64_t i = 0; i < source.extents.x; ++i) out[i] = T(unit.number(double(from[i])));
    return true;
  };
  return convolve<T>(volume, lattice, wide, spline, unit, row, progress);
}

template Coefficients<double> bcc_coefficients(const Volume&, const BccMask&, int, std::string_view, const ValueUnit&, const Progress&);
template Coefficients<float> bcc_coefficients(const Volume&, const BccMask&, int, std::string_view, const ValueUnit&, const Progress&);
template Coefficients<double> axis_coefficients(const Volume&, LatticeKind, const AxisMask&, int, std::string_view, const ValueUnit&, const Progress&);
template Coefficients<float> axis_coefficients(const Volume&, LatticeKind, const AxisMask&, int, std::string_view, const ValueUnit&, const Progress&);

}  // namespace quincunx

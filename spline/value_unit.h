// The unit that rounded coefficients are kept in.
#pragma once

#include "lattice/volume.h"

namespace quincunx {

/// What the numbers of coefficients stand for: value = offset + scale * number. Splines reproduce constants, so the spline of the numbers
/// is that of the values in this unit, and its gradient by `scale` too small.
struct ValueUnit {
  double offset = 0.0;
  double scale = 1.0;  ///< of float_unit a power of two: scaling by it rounds nothing

  double number(double value) const { return (value - offset) / scale; }
  double value(double number) const { return offset + scale * number; }
  /// Numbers are values.
  bool plain() const { return offset == 0.0 && scale == 1.0; }
  bool operator==(const ValueUnit&) const = default;
};

/// The unit in which 32-bit floats hold coefficients of samples of `type` from `low` to `high` (finite) without loss that could be spared: plain, but
/// for float samples which lie so far from 0 that what they differ by would lose three bits and more, and get an offset;
/// and for those so large or small that products of them leave the range of floats, and get a scale.
ValueUnit float_unit(SampleType type, double low, double high);

}  // namespace quincunx

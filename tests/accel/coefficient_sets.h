// Coefficients that are hard on bounds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accel/bounds.h"

namespace quincunx {

/// Coefficients with an apron that repeats the border, of two samples: enough for every spline, and for Cartesian axes of one sample;
/// value(coset, index) is rounded to float.
Coefficients<float> make_coefficients(const Extents& extents, const std::function<double(int, const glm::i64vec3&)>& value,
                                      LatticeKind lattice = LatticeKind::bcc);

/// The same numbers in double.
Coefficients<double> in_double(const Coefficients<float>& c);

struct CoefficientSet {
  std::string name;
  Coefficients<float> c;
};

/// Noise, alternating signs, spikes, constants, tiny and huge numbers, on extents that no block divides and on axes of
/// one sample.
std::vector<CoefficientSet> coefficient_sets(LatticeKind lattice = LatticeKind::bcc);

/// Smooth with some noise: like a scan.
Coefficients<float> smooth_coefficients(const Extents& extents, LatticeKind lattice = LatticeKind::bcc);

/// Bounds of the bcc7 spline.
CellBounds bounds_of(const Coefficients<float>& c);

}  // namespace quincunx

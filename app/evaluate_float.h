// A spline's sum in 32-bit floats: what is lost with single precision.
#pragma once

#include "spline/spline.h"

namespace quincunx {

/// s and its gradient at u (lattice coordinates, inside the domain): the coefficients that reach u, each times its
/// weight M(u - j) rounded to float, multiplied and added in floats. The weights themselves are found in double.
Jet evaluate_float(const Spline& spline, const Coefficients<float>& c, const glm::dvec3& u);

}  // namespace quincunx

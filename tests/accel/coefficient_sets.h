// Coefficients that are hard on bounds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "spline/coefficients.h"

namespace quincunx {

/// BCC coefficients with an apron of one sample that repeats the border; value(coset, index) is rounded to float.
Coefficients<float> make_coefficients(const Extents& extents,
                                      const std::function<double(int, const glm::i64vec3&)>& value);

/// The same numbers in double.
Coefficients<double> in_double(const Coefficients<float>& c);

struct CoefficientSet {
  std::string name;
  Coefficients<float> c;
};

/// Noise, alternating signs, spikes, constants, tiny and huge numbers, on extents that no block divides and on axes of
/// one sample.
std::vector<CoefficientSet> coefficient_sets();

/// Smooth with some noise: like a scan.
Coefficients<float> smooth_coefficients(const Extents& extents);

}  // namespace quincunx

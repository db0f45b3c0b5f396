// Light and compositing: the formulas that the kernels repeat in float.
#pragma once

#include <glm/glm.hpp>

#include "lattice/lattice.h"
#include "spline/spline.h"

namespace quincunx {

/// The unit normal along `gradient` (world, any length), turned to face the viewer: dot(normal, direction) <= 0.
/// A gradient of 0, or none that is finite, gives -direction.
glm::dvec3 facing_normal(const glm::dvec3& gradient, const glm::dvec3& direction);

/// color * (ambient + (1 - ambient) * max(0, -dot(normal, direction))): a light at the eye.
glm::dvec3 headlight(const glm::dvec3& color, double ambient, const glm::dvec3& normal, const glm::dvec3& direction);

/// Surfaces gathered front to back.
struct Composite {
  glm::dvec3 color{0.0};       ///< premultiplied
  double transmittance = 1.0;  ///< what shines through all surfaces so far; 0 behind an opaque one

  /// Puts a surface behind those before: color += transmittance opacity c, transmittance *= 1 - opacity.
  void behind(const glm::dvec3& c, double opacity);
};

/// Differences of `spline` over +-delta cells about u (in the domain) along each lattice axis, per lattice coordinate. Both
/// places are clamped to the domain and the difference is divided by their distance; 0 where that is 0.
glm::dvec3 central_difference(const Spline& spline, const Coefficients<double>& coefficients, const glm::dvec3& u,
                              double delta);

}  // namespace quincunx

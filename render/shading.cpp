#include "render/shading.h"

#include <algorithm>
#include <cmath>

namespace quincunx {

glm::dvec3 facing_normal(const glm::dvec3& gradient, const glm::dvec3& direction) {
  // Scale first: the square of a small or large gradient is not a double.
  const double largest = std::max({std::abs(gradient.x), std::abs(gradient.y), std::abs(gradient.z)});
  if (!(largest > 0.0) || !std::isfinite(largest)) return -direction;
  const glm::dvec3 normal = glm::normalize(gradient / largest);
  return glm::dot(normal, direction) > 0.0 ? -normal : normal;
}

glm::dvec3 headlight(const glm::dvec3& color, double ambient, const glm::dvec3& normal, const glm::dvec3& direction) {
  return color * (ambient + (1.0 - ambient) * std::max(0.0, -glm::dot(normal, direction)));
}

void Composite::behind(const glm::dvec3& c, double opacity) {
  color += transmittance * opacity * c;
  transmittance *= 1.0 - opacity;
}

glm::dvec3 central_difference(const Spline& spline, const Coefficients<double>& coefficients, const glm::dvec3& u,
                              double delta) {
  const glm::dvec3 far(domain_max(coefficients.lattice, coefficients.extents));
  glm::dvec3 gradient(0.0);
  for (int a = 0; a < 3; ++a) {
    glm::dvec3 low = u, high = u;
    low[a] = std::max(u[a] - delta, 0.0);
    high[a] = std::min(u[a] + delta, far[a]);
    if (!(low[a] < high[a])) continue;
    gradient[a] = (spline.evaluate(coefficients, high).value - spline.evaluate(coefficients, low).value) /
                  (high[a] - low[a]);
  }
  return gradient;
}

}  // namespace quincunx

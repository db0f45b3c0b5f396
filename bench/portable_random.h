// Random numbers that every standard library draws alike.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

namespace quincunx {

/// The same sequence in every object.
class PortableRandom {
 public:
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * 0x1p-32 * double(engine_()); }
  /// In the cube [0, edge)^3.
  glm::dvec3 point(double edge) { return {uniform(0.0, edge), uniform(0.0, edge), uniform(0.0, edge)}; }
  /// On the unit sphere, uniformly.
  glm::dvec3 direction() {
    const double z = uniform(-1.0, 1.0), angle = uniform(0.0, 2.0 * std::numbers::pi), r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937 engine_{7};
};

}  // namespace quincunx

// Shapes that made-up masks and volumes have in common, drawn as ellipsoids on a canvas: `double edge()` of the cube that it is, and
// `ellipsoid(middle, radii)`.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "bench/portable_random.h"

namespace quincunx {

/// Whether p is outside the cube [0, edge]^3.
inline bool outside(const glm::dvec3& p, double edge) { return glm::clamp(p, 0.0, edge) != p; }

/// The way on after a step along d: a little to one side.
inline glm::dvec3 wound(const glm::dvec3& d, double by, PortableRandom& random) { return glm::normalize(d + by * random.direction()); }

/// One ellipsoid that scales with the canvas.
void draw_solid_part(auto& canvas, PortableRandom& random) {
  const double edge = canvas.edge();
  const glm::dvec3 middle = random.point(edge);
  canvas.ellipsoid(middle, edge * glm::dvec3{random.uniform(0.05, 0.2), random.uniform(0.05, 0.2), random.uniform(0.05, 0.2)});
}

/// A vessel from p along d, then the two that it divides into, down to the radius `least`.
void draw_vessel(auto& canvas, PortableRandom& random, glm::dvec3 p, glm::dvec3 d, double radius, double least) {
  if (radius < least) return;
  const double length = radius * random.uniform(6.0, 10.0), step = 0.5 * radius;
  for (double along = 0.0; along < length; along += step, p += step * d) {
    if (outside(p, canvas.edge())) return;
    canvas.ellipsoid(p, glm::dvec3(radius));
    d = wound(d, 0.1, random);
  }
  const double child = radius / std::cbrt(2.0);  // the cubes of the radii add up
  for (int n = 0; n < 2; ++n) draw_vessel(canvas, random, p, wound(d, 0.8, random), child, least);
}

/// Three trees of vessels; begins(n) is called before each.
void draw_vessels(auto& canvas, double least, const auto& begins) {
  PortableRandom random;
  const double edge = canvas.edge();
  for (int n = 0; n < 3; ++n) {
    begins(n);
    draw_vessel(canvas, random, edge * glm::dvec3{0.25 + 0.25 * n, 0.5, 0.0}, glm::dvec3(0.0, 0.0, 1.0), std::max(edge / 24.0, 1.0), least);
  }
}

}  // namespace quincunx

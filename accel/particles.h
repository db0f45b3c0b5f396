// Point sets as voxels: a sphere about each point.
#pragma once

#include <span>

#include "accel/voxels.h"

namespace quincunx {

/// World units and data units; the radius is above 0.
struct Particle {
  glm::dvec3 centre{0.0};
  double radius = 1.0, density = 1.0;
};

/// Spheres of one density each, in the smallest box that holds them all, whose cell is as long as the greatest radius; opacities that name no length belong to that too.
/// Spheres have no gradients: they are lit by their normals. Throws InputError, naming `what` (a file), where there is none, a number is not finite or a radius not above 0, or
/// the box is more than 65535 cells long.
Voxels particle_voxels(std::span<const Particle> particles, std::string_view what);

}  // namespace quincunx

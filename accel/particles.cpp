#include "accel/particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kMostCells = 65535.0;  // of the domain: beyond it a sphere's place as a float is rounded by more than 1/256 of a radius

void check(std::span<const Particle> particles, std::string_view what) {
  if (particles.empty()) throw InputError(fmt::format("{}: found no particle, expected at least one", what));
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const Particle& p = particles[n];
    if (!(p.radius > 0.0)) throw InputError(fmt::format("{}: found the radius {} of particle {}, expected one above 0", what, p.radius, n + 1));
    if (!std::isfinite(glm::dot(p.centre, p.centre)) || !std::isfinite(p.radius) || !std::isfinite(p.density))
      throw InputError(fmt::format("{}: found numbers of particle {} that are not finite or too large", what, n + 1));
  }
}

}  // namespace

Voxels particle_voxels(std::span<const Particle> particles, std::string_view what) {
  check(particles, what);
  glm::dvec3 low = particles.front().centre, high = low;
  double radius = 0.0;
  VoxelScale scale{particles.front().density, particles.front().density, 0.0};
  for (const Particle& p : particles) {
    low = glm::min(low, p.centre - p.radius), high = glm::max(high, p.centre + p.radius);
    radius = std::max(radius, p.radius);
    scale.low = std::min(scale.low, p.density), scale.high = std::max(scale.high, p.density);
  }
  // A little room, so that no sphere is cut where it touches the border.
  constexpr double kRoom = 1e-3;
  const glm::dvec3 cells = glm::ceil((high - low) / radius + kRoom);
  if (!(std::max({cells.x, cells.y, cells.z}) <= kMostCells))
    throw InputError(fmt::format("{}: found particles up to {:g} apart with radii of at most {:g}, expected at most {} radii", what,
                                 std::max({high.x - low.x, high.y - low.y, high.z - low.z}), radius, int(kMostCells)));
  Voxels voxels;
  voxels.shape = VoxelShape::sphere;
  voxels.extents = Extents(cells) + std::int64_t(1);
  voxels.world.axes = glm::dmat3(radius);
  const glm::dvec3 centre = 0.5 * (low + high);
  voxels.world.origin = centre - 0.5 * radius * cells;
  voxels.unit = radius;
  voxels.scale = scale;
  voxels.samples = particles.size();
  for (const Particle& p : particles) {
    const glm::vec3 place((p.centre - centre) / radius);
    voxels.data.push_back(pack(VoxelShape::sphere, p.density, glm::dvec3(0.0), scale));
    voxels.spheres.push_back({{place.x, place.y, place.z}, float(p.radius / radius)});
  }
  return voxels;
}

}  // namespace quincunx

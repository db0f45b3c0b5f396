// Rays in lattice coordinates: clipped to the domain, and walked cell by cell.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lattice/lattice.h"

namespace quincunx {

/// The part of a ray inside the domain: u(s) = origin + s * direction, 0 <= s <= length, all in lattice coordinates.
/// s counts from the entry, so that no digits are lost to an eye that is far away.
struct LatticeRay {
  glm::dvec3 origin;     ///< where the ray enters the domain: the eye itself where that is inside
  glm::dvec3 direction;  ///< unit length in lattice coordinates: s is in cells
  double length = 0.0;
  double entry = 0.0;  ///< distance from the eye to `origin`, world units
  double scale = 0.0;  ///< world units per cell along this ray

  glm::dvec3 point(double s) const { return origin + s * direction; }
  /// Distance from the eye along the ray, world units.
  double distance(double s) const { return entry + s * scale; }
};

/// What the rays from one eye into one volume share.
struct RaySpace {
  glm::dmat3 inverse_axes;  ///< world directions to lattice directions
  glm::dvec3 eye;           ///< in lattice coordinates
  glm::dvec3 far;           ///< the domain is the box [0, far], lattice coordinates
  glm::ivec3 cells;         ///< per axis, at least 1
};

/// `eye` in world units. Throws InputError where the world's axes do not span space.
RaySpace ray_space(LatticeKind lattice, const Extents& extents, const World& world, const glm::dvec3& eye);

/// The part of the ray from the eye along `direction` (unit, world) inside the closed domain; none where it misses it.
std::optional<LatticeRay> clip_ray(const RaySpace& space, const glm::dvec3& direction);

/// The cells (unit cubes) that a ray passes, in order: u(s) is in `cell()` for enter() <= s <= exit(). The exits are the
/// parameters of the lattice planes, computed from the ray's origin, so that the sequence is a function of the ray alone.
class CellWalk {
 public:
  CellWalk(const LatticeRay& ray, const glm::ivec3& cells);

  bool done() const { return done_; }
  const glm::ivec3& cell() const { return cell_; }
  double enter() const { return enter_; }
  double exit() const { return exit_; }
  void advance();

 private:
  void find_exit();

  const LatticeRay& ray_;
  glm::ivec3 cells_, cell_{0}, step_{0};
  glm::dvec3 next_{0.0};  ///< parameter of the next lattice plane of each axis; infinite where there is none
  double enter_ = 0.0, exit_ = 0.0;
  bool done_ = false;
};

}  // namespace quincunx

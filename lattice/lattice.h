// The two lattices and the conventions of their coordinates (README, "Conventions").
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

namespace quincunx {

/// Which points carry samples, in lattice coordinates u.
///   bcc:       integer points whose three coordinates are all even or all odd
///   cartesian: all integer points
enum class LatticeKind { bcc, cartesian };

/// "bcc" or "cartesian".
std::string_view lattice_name(LatticeKind kind);

/// The kind of that name; throws InputError, naming `what` (a flag or a file) and the choices.
LatticeKind parse_lattice(std::string_view name, std::string_view what);

/// Samples per axis: of each coset for bcc (coset c, index (i,j,k) stands at
/// u = (2i+c, 2j+c, 2k+c)), of the grid for cartesian (u = (i,j,k)).
using Extents = glm::i64vec3;

/// Number of cosets of cubic grids: 2 for bcc, 1 for cartesian.
int coset_count(LatticeKind kind);

/// Lattice coordinates per index step along an axis: 2 for bcc, 1 for cartesian.
int lattice_step(LatticeKind kind);

/// The far corner of the domain, lattice coordinates: 2n-1 for bcc, n-1 for cartesian.
/// The domain is the box [0, domain_max], to which rays are clipped.
glm::i64vec3 domain_max(LatticeKind kind, const Extents& extents);

/// Cells (unit cubes of lattice coordinates, lower corner (x,y,z), 0 <= x < cell_count.x ...): those that fill the domain,
/// and one along a Cartesian axis of one sample, on whose lower face the domain lies.
glm::i64vec3 cell_count(LatticeKind kind, const Extents& extents);

/// The cell of u in the domain [0, domain_max]: floor(u), clamped to the cells there are, so that every point of the
/// closed domain has one. A point on a face between cells goes to the upper one.
glm::ivec3 cell_of(const glm::dvec3& u, const glm::i64vec3& domain_max);

/// Where lattice coordinates lie in the world: x = origin + axes * u. Column a of `axes` is e_a,
/// the world step of one lattice coordinate: half the coset grid's step for bcc, the voxel step for cartesian.
struct World {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};

  glm::dvec3 to_world(const glm::dvec3& u) const { return origin + axes * u; }
  glm::dvec3 to_lattice(const glm::dvec3& x) const { return glm::inverse(axes) * (x - origin); }
  /// A gradient per lattice coordinate as one per world unit (inverse transpose).
  glm::dvec3 gradient_to_world(const glm::dvec3& g) const { return glm::transpose(glm::inverse(axes)) * g; }
};

// The body is here: it is a few instructions, inside every evaluation.

inline glm::ivec3 cell_of(const glm::dvec3& u, const glm::i64vec3& domain_max) {
  const glm::dvec3 last(glm::max(domain_max - std::int64_t(1), glm::i64vec3(0)));
  return glm::ivec3(glm::clamp(glm::floor(u), glm::dvec3(0.0), last));
}

}  // namespace quincunx

// The tetrahedra into which the knot planes of the BCC splines cut space.
#pragma once

#include <glm/glm.hpp>

namespace quincunx {

/// One of the 6 Kuhn tetrahedra of a cell (unit cube of lattice coordinates).
///
/// A cell has one all-even and one all-odd corner, opposite each other. A tetrahedron walks from the even corner
/// v0 to the odd corner v3, one axis at a time: v1 = v0 + sign[axis[0]] e_axis[0], and so on. In the frame
/// w = sign * (u - even), sorted by `axis`, it is 1 >= w1 >= w2 >= w3 >= 0: one reference tetrahedron for all 24 kinds.
struct Tetrahedron {
  glm::ivec3 even;  ///< v0, lattice coordinates, all even
  glm::ivec3 sign;  ///< +1 or -1 per axis; even + sign is v3, all odd
  glm::ivec3 axis;  ///< the order in which the axes are walked, a permutation of 0, 1, 2

  /// Vertex v0..v3, lattice coordinates.
  glm::ivec3 vertex(int i) const;
  /// The frame's coordinates (w1, w2, w3) of a point u (lattice coordinates); exact where u is within a cell of v0.
  glm::dvec3 frame(const glm::dvec3& u) const;
  /// Barycentric coordinates of u with respect to v0..v3: (1 - w1, w1 - w2, w2 - w3, w3).
  glm::dvec4 barycentric(const glm::dvec3& u) const;
  /// A gradient per (w1, w2, w3) as one per lattice coordinate.
  glm::dvec3 gradient_from_frame(const glm::dvec3& g) const;

  bool operator==(const Tetrahedron&) const = default;
};

/// The tetrahedron of `cell` (its lower corner) that holds u; the nearest by order of coordinates where u is outside
/// the cell. A point on a face between tetrahedra goes to the one that holds u + (e, e^2, e^3) for small e > 0, so that shifts by lattice
/// points do not change which side it goes to.
Tetrahedron locate(const glm::ivec3& cell, const glm::dvec3& u);

// The bodies are here: they are a few instructions each, inside every evaluation.

inline glm::ivec3 Tetrahedron::vertex(int i) const {
  glm::ivec3 v = even;
  for (int a = 0; a < i; ++a) v[axis[a]] += sign[axis[a]];
  return v;
}

inline glm::dvec3 Tetrahedron::frame(const glm::dvec3& u) const {
  const glm::dvec3 w = glm::dvec3(sign) * (u - glm::dvec3(even));
  return {w[axis[0]], w[axis[1]], w[axis[2]]};
}

inline glm::dvec4 Tetrahedron::barycentric(const glm::dvec3& u) const {
  const glm::dvec3 w = frame(u);
  return {1.0 - w.x, w.x - w.y, w.y - w.z, w.z};
}

inline glm::dvec3 Tetrahedron::gradient_from_frame(const glm::dvec3& g) const {
  glm::dvec3 r(0.0);
  for (int a = 0; a < 3; ++a) r[axis[a]] = sign[axis[a]] * g[a];
  return r;
}

inline Tetrahedron locate(const glm::ivec3& cell, const glm::dvec3& u) {
  const glm::ivec3 odd = cell & 1;
  Tetrahedron t{cell + odd, 1 - 2 * odd, {0, 1, 2}};
  const glm::dvec3 w = glm::dvec3(t.sign) * (u - glm::dvec3(t.even));
  // Rank each axis by its coordinate, descending; of two equal ones the lower axis comes first if it ascends with u.
  const bool x_ascends = t.sign.x > 0, y_ascends = t.sign.y > 0;
  const bool y_before_x = w.y > w.x || (w.y == w.x && !x_ascends);
  const int rank_x = y_before_x + (w.z > w.x || (w.z == w.x && !x_ascends));
  const int rank_y = !y_before_x + (w.z > w.y || (w.z == w.y && !y_ascends));
  t.axis[rank_x] = 0;
  t.axis[rank_y] = 1;
  t.axis[3 - rank_x - rank_y] = 2;
  return t;
}

}  // namespace quincunx

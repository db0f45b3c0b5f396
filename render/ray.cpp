#include "render/ray.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

RaySpace ray_space(LatticeKind lattice, const Extents& extents, const World& world, const glm::dvec3& eye) {
  RaySpace space;
  space.inverse_axes = glm::inverse(world.axes);
  if (!finite(space.inverse_axes[0]) || !finite(space.inverse_axes[1]) || !finite(space.inverse_axes[2]))
    throw InputError("volume: its three step vectors lie in one plane; expected them to span space");
  space.eye = space.inverse_axes * (eye - world.origin);
  space.far = glm::dvec3(domain_max(lattice, extents));
  space.cells = glm::max(glm::ivec3(space.far), glm::ivec3(1));
  return space;
}

std::optional<LatticeRay> clip_ray(const RaySpace& space, const glm::dvec3& direction) {
  const glm::dvec3 d = space.inverse_axes * direction;
  const double length = glm::length(d);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;

  LatticeRay ray;
  ray.direction = d / length;
  ray.scale = 1.0 / length;

  // Intersect the three slabs; `from` and `to` are in cells from the eye.
  double from = 0.0, to = kInfinity;
  int entry_axis = -1;
  for (int a = 0; a < 3; ++a) {
    if (ray.direction[a] == 0.0) {
      if (!(space.eye[a] >= 0.0 && space.eye[a] <= space.far[a])) return std::nullopt;
      continue;
    }
    double near_side = (0.0 - space.eye[a]) / ray.direction[a];
    double far_side = (space.far[a] - space.eye[a]) / ray.direction[a];
    if (near_side > far_side) std::swap(near_side, far_side);
    if (near_side > from) {
      from = near_side;
      entry_axis = a;
    }
    to = std::min(to, far_side);
  }
  if (!(from <= to)) return std::nullopt;

  // Enter at `from`: exactly on the plane of the entry axis, and never outside by rounding.
  ray.entry = from * ray.scale;
  ray.origin = glm::clamp(space.eye + from * ray.direction, glm::dvec3(0.0), space.far);
  if (entry_axis >= 0) ray.origin[entry_axis] = ray.direction[entry_axis] > 0.0 ? 0.0 : space.far[entry_axis];

  // Measure the length from the entry: the same numbers as the walk's last planes.
  ray.length = kInfinity;
  for (int a = 0; a < 3; ++a) {
    if (ray.direction[a] == 0.0) continue;
    const double plane = ray.direction[a] > 0.0 ? space.far[a] : 0.0;
    ray.length = std::min(ray.length, (plane - ray.origin[a]) / ray.direction[a]);
  }
  return ray;
}

CellWalk::CellWalk(const LatticeRay& ray, const glm::ivec3& cells) : ray_(ray), cells_(cells) {
  for (int a = 0; a < 3; ++a) {
    const double d = ray.direction[a], o = ray.origin[a];
    step_[a] = d > 0.0 ? 1 : d < 0.0 ? -1 : 0;
    cell_[a] = int(std::floor(o));
    // Standing on a plane, the ray leaves it towards its direction.
    if (step_[a] < 0 && double(cell_[a]) == o) --cell_[a];
    cell_[a] = std::clamp(cell_[a], 0, cells[a] - 1);
    next_[a] = step_[a] == 0 ? kInfinity : (double(cell_[a] + (step_[a] > 0)) - o) / d;
  }
  find_exit();
}

void CellWalk::find_exit() {
  exit_ = std::max(enter_, std::min({next_.x, next_.y, next_.z, ray_.length}));
}

void CellWalk::advance() {
  enter_ = exit_;
  // The ray's end may lie before every lattice plane: a domain of one layer is thinner than its cells.
  done_ = exit_ >= ray_.length;
  for (int a = 0; a < 3; ++a) {
    if (next_[a] > exit_) continue;
    cell_[a] += step_[a];
    done_ = done_ || cell_[a] < 0 || cell_[a] >= cells_[a];
    next_[a] = (double(cell_[a] + (step_[a] > 0)) - ray_.origin[a]) / ray_.direction[a];
  }
  if (!done_) find_exit();
}

}  // namespace quincunx

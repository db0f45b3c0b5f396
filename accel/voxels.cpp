#include "accel/voxels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace quincunx {
namespace {

constexpr double kDensities = 65535.0, kMagnitudes = 16383.0, kDirections = 32767.0;

std::uint32_t nearest(double x, double most) { return std::uint32_t(std::lround(std::clamp(x, 0.0, most))); }

double sign_of(double x) { return x < 0.0 ? -1.0 : 1.0; }

/// The place of a direction on the unfolded octahedron, -1..1.
glm::dvec2 unfold(const glm::dvec3& n) {
  const glm::dvec3 p = n / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  if (p.z >= 0.0) return {p.x, p.y};
  return {(1.0 - std::abs(p.y)) * sign_of(p.x), (1.0 - std::abs(p.x)) * sign_of(p.y)};
}

glm::dvec3 fold(const glm::dvec2& p) {
  const double z = 1.0 - std::abs(p.x) - std::abs(p.y);
  if (z >= 0.0) return glm::normalize(glm::dvec3(p, z));
  return glm::normalize(glm::dvec3((1.0 - std::abs(p.y)) * sign_of(p.x), (1.0 - std::abs(p.x)) * sign_of(p.y), z));
}

}  // namespace

VoxelData pack(VoxelShape shape, double density, const glm::dvec3& gradient, const VoxelScale& scale) {
  const double range = scale.high - scale.low;
  const std::uint32_t d = range > 0.0 ? nearest((density - scale.low) / range * kDensities, kDensities) : 0;
  VoxelData data{{std::uint32_t(shape) | d << 2, 0}};
  // Scale first: the square of a small or large gradient is not a double.
  const double largest = std::max({std::abs(gradient.x), std::abs(gradient.y), std::abs(gradient.z)});
  if (!(largest > 0.0) || !(scale.steepest > 0.0)) return data;
  const glm::dvec3 scaled = gradient / largest;
  const double magnitude = largest * glm::length(scaled) / scale.steepest * kMagnitudes;
  data.words[0] |= std::max(nearest(magnitude, kMagnitudes), 1u) << 18;
  const glm::dvec2 p = unfold(scaled);
  data.words[1] = nearest((p.x + 1.0) * kDirections, 2.0 * kDirections) | nearest((p.y + 1.0) * kDirections, 2.0 * kDirections) << 16;
  return data;
}

VoxelLook unpack(const VoxelData& data, const VoxelScale& scale) {
  VoxelLook look;
  look.density = data.words[0] >> 2 & 0xffffu;
  const std::uint32_t magnitude = data.words[0] >> 18;
  if (magnitude == 0) return look;
  look.magnitude = scale.steepest * (double(magnitude) / kMagnitudes);
  look.direction = fold({double(data.words[1] & 0xffffu) / kDirections - 1.0, double(data.words[1] >> 16) / kDirections - 1.0});
  return look;
}

glm::ivec3 Voxels::edges(int level) const {
  return {grows.x ? edge.x << level : edge.x, grows.y ? edge.y << level : edge.y, grows.z ? edge.z << level : edge.z};
}

VoxelBox Voxels::box(std::size_t n) const {
  if (shape == VoxelShape::cuboid) {
    const VoxelPlace& p = places[n];
    const glm::ivec3 low = glm::ivec3(p.low[0], p.low[1], p.low[2]) - kVoxelOrigin;
    return {0.5 * glm::dvec3(low), 0.5 * glm::dvec3(low + edges(p.level))};
  }
  const SpherePlace& s = spheres[n];
  const glm::dvec3 centre = glm::dvec3(s.centre[0], s.centre[1], s.centre[2]) + 0.5 * glm::dvec3(domain_max(lattice, extents));
  return {centre - double(s.radius), centre + double(s.radius)};
}

}  // namespace quincunx

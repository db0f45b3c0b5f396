// Voxels as primitives: what `quincunx render --render bih` shows in place of a spline of the samples.
//
// M. Kinkelin, "GPU Volume Raycasting using Bounding Interval Hierarchies", student project, TU Wien 2009: every voxel is a leaf of a bounding interval
// hierarchy, a cuboid or another finite element, of one density and one gradient, packed into 62 bits. There a leaf's place is implied by the planes above it;
// here planes are rounded to 16 bits (accel/bih_build.h), so that the place stands beside, in 8 bytes more.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lattice/lattice.h"

namespace quincunx {

/// What a voxel shows: 8 bytes, of which 62 bits are its data.
///
///   bits    what
///   0..1    its shape, a VoxelShape
///   2..17   density: low + n (high - low) / 65535 (VoxelScale)
///   18..31  magnitude of the gradient: n steepest / 16383; 0 for no gradient alone
///   32..47  direction of the gradient (world), octahedral: first coordinate, n / 32767 - 1, n up to 65534
///   48..63  second coordinate
///
/// Octahedral: Q. Meyer, J. Suessmuth, G. Sussner, M. Stamminger, G. Greiner, "On floating-point normal vectors", Computer Graphics Forum 29(4), 2010,
/// doi:10.1111/j.1467-8659.2010.01737.x. Twin: shaders/voxel.glsl.
struct VoxelData {
  std::uint32_t words[2];
};
static_assert(sizeof(VoxelData) == 8);

enum class VoxelShape : std::uint32_t { cuboid = 0, sphere = 1 };

/// Where a cuboid is: 8 bytes, in half cells.
///
///   offset  what
///        0  its low corner, 16 bits an axis: u = n / 2 - 1 (lattice coordinates)
///        6  level: edges that Voxels::grows names are 2^level times as long as a sample's
struct VoxelPlace {
  std::uint16_t low[3];
  std::uint16_t level;
};
static_assert(sizeof(VoxelPlace) == 8);

/// Where a sphere is: 16 bytes. Lattice coordinates relative to the domain's centre, and cells.
struct SpherePlace {
  float centre[3];
  float radius;
};
static_assert(sizeof(SpherePlace) == 16);

/// How numbers are quantised.
struct VoxelScale {
  double low = 0.0, high = 0.0;  ///< densities, data units
  double steepest = 0.0;         ///< magnitude of gradients, data units per world unit

  double density(std::uint32_t n) const { return low + (high - low) * (double(n) / 65535.0); }
};

/// A density and a gradient (world); the nearest there are. `density` within the scale's, the gradient's magnitude at most its steepest.
VoxelData pack(VoxelShape shape, double density, const glm::dvec3& gradient, const VoxelScale& scale);
/// What that is read as.
struct VoxelLook {
  std::uint32_t density = 0;  ///< its number, for VoxelScale::density
  glm::dvec3 direction{0.0};  ///< of the gradient, unit; 0 where there is none
  double magnitude = 0.0;
};
VoxelLook unpack(const VoxelData& data, const VoxelScale& scale);

/// A box in lattice coordinates.
struct VoxelBox {
  glm::dvec3 low, high;
};

/// A set of voxels of one shape in a domain to which rays are clipped, as they are to a volume's.
struct Voxels {
  LatticeKind lattice = LatticeKind::cartesian;
  Extents extents{0};  ///< of the domain, as a volume's
  World world;
  double unit = 1.0;   ///< world length to which opacities belong that name none
  VoxelShape shape = VoxelShape::cuboid;
  glm::ivec3 edge{2};  ///< of a sample's cuboid, half cells
  glm::bvec3 grows{true};  ///< which edges double from level to level
  VoxelScale scale;
  std::vector<VoxelData> data;
  std::vector<VoxelPlace> places;    ///< of cuboids, as many as data
  std::vector<SpherePlace> spheres;  ///< of spheres, as many as data
  std::uint64_t samples = 0;         ///< that they were made of
  std::uint64_t sample_bytes = 0;    ///< of these as a plain grid; 0 for particles

  std::size_t size() const { return data.size(); }
  glm::ivec3 edges(int level) const;  ///< half cells
  /// The box of voxel n in lattice coordinates.
  VoxelBox box(std::size_t n) const;
  std::uint64_t place_bytes() const { return places.size() * sizeof(VoxelPlace) + spheres.size() * sizeof(SpherePlace); }
};

/// Half cells between the origin of VoxelPlace and u = 0.
inline constexpr int kVoxelOrigin = 2;

}  // namespace quincunx

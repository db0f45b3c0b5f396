// Bricks: a volume's coefficients cut into equal cubes that can be evaluated one by one, for volumes larger than memory.
//
// Page tables over bricks: M. Hadwiger, J. Beyer, W.-K. Jeong, H. Pfister, Interactive volume exploration of petascale microscopy
// data streams using a visualization-driven virtual memory approach, 2012, DOI 10.1109/TVCG.2012.240; only the bricks a scene
// activates: Ganter, Manzke, An analysis of region clustered BVH volume rendering on GPU, 2019, section 5.3, DOI 10.1111/cgf.13756.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "accel/classification.h"
#include "lattice/lattice.h"

namespace quincunx {

/// How a volume is cut into bricks and how one lies in its slot of the pool. All slots are alike.
///
/// Brick (x,y,z) has the cells b*edge <= cell < (b+1)*edge on every axis, the last one of an axis perhaps fewer. Its slot holds, of
/// every coset, `samples` coefficients an axis beginning with first_index(): those that the spline reaches from any of its cells
/// (`apron` further than the corners of a cell). No evaluation needs two bricks.
///
///   cartesian  corners b*edge .. (b+1)*edge:      edge + 1 + 2 apron
///   bcc        even corners at half of that:    edge/2 + 1 + 2 apron, odd ones at one less, whose last is never read
///
/// Where a slot reaches beyond the volume it repeats the border, as Coefficients does; so it is laid out as the `data` of
/// Coefficients with the same apron, of samples - 2 apron an axis.
struct BrickLayout {
  static constexpr std::int64_t kMostBricks = std::int64_t(1) << 27;  ///< a page table of 2^29 bytes

  LatticeKind lattice = LatticeKind::bcc;
  Extents extents{0};  ///< of the volume
  int apron = 0;       ///< the spline's
  int edge = 32;       ///< cells, a power of two
  glm::ivec3 bricks{0};
  int samples = 0;  ///< of a slot, each coset, an axis

  /// Checks `edge`, 4..256 and a power of two, and that every brick has a number and an origin. Throws InputError naming --brick.
  BrickLayout(LatticeKind lattice, const Extents& extents, int apron, int edge);

  std::int64_t count() const { return std::int64_t(bricks.x) * bricks.y * bricks.z; }
  /// Bricks are numbered x fastest.
  std::int32_t number(const glm::ivec3& brick) const { return (brick.z * bricks.y + brick.y) * bricks.x + brick.x; }
  glm::ivec3 brick(std::int32_t number) const {
    return {number % bricks.x, number / bricks.x % bricks.y, number / (bricks.x * bricks.y)};
  }
  glm::ivec3 brick_of_cell(const glm::ivec3& cell) const { return cell / edge; }

  /// The index, of every coset, of the first coefficient in the slot of `brick`: -apron for the first brick.
  glm::i64vec3 first_index(const glm::ivec3& brick) const {
    return glm::i64vec3(brick) * std::int64_t(edge / lattice_step(lattice)) - std::int64_t(apron);
  }
  /// Numbers of coefficients per index along y, along z, and from the first coset to the second.
  glm::ivec3 strides() const { return {samples, samples * samples, samples * samples * samples}; }
  std::int64_t slot_floats() const { return std::int64_t(coset_count(lattice)) * samples * samples * samples; }
  std::uint64_t slot_bytes() const { return std::uint64_t(slot_floats()) * sizeof(float); }

  /// What a page table holds of a brick in `slot`: the number in the pool of (coset 0; index 0,0,0), which may lie outside of it, so that
  /// coefficient (c; i,j,k) of the whole volume's numbering is number origin + c strides.z + i + j strides.x + k strides.y.
  std::int32_t origin(const glm::ivec3& brick, int slot) const;

  /// How many slots a pool of so many bytes has, at most one for each brick. Throws InputError naming --pool where that is none, or more
  /// than the numbers of coefficients, 32 bits with a sign, can tell apart.
  int slots(std::uint64_t pool_bytes) const;
};

/// The brick of the point of the volume that is nearest to `eye`, lattice coordinates.
glm::ivec3 eye_brick(const BrickLayout& layout, const glm::dvec3& eye);

/// Sorts numbers of bricks by the distance of their coordinates from eye_brick, |dx| + |dy| + |dz|, then by number.
///
/// No brick hides one before it in this order. Along a ray from the eye each brick coordinate never comes back: where the eye's own
/// coordinate is inside the volume, it leaves that of eye_brick and goes away from it; where it is beside the volume, eye_brick has the
/// coordinate of the nearest side, and only rays that go on from there into the volume meet any brick. So each of the three terms grows or
/// stays along the ray, and from one brick to the next at least one grows.
void sort_front_to_back(const BrickLayout& layout, const glm::dvec3& eye, std::vector<std::int32_t>& bricks);

/// One number a brick: 1 where a block that may hold something has cells in it, else 0. Blocks and bricks may be of any sizes.
std::vector<std::uint8_t> active_bricks(const BrickLayout& layout, const Classification& blocks);

}  // namespace quincunx

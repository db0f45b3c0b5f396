// Lattices laid over the domain of a volume, to resample it on.
#pragma once

#include <cstdint>

#include "lattice/volume.h"

namespace quincunx {

/// Where samples are to stand: a volume without them.
struct TargetGrid {
  LatticeKind lattice = LatticeKind::cartesian;
  Extents extents{0};
  World world;
};

// All of them share origin and directions of axes with the volume `source`, of which only lattice, extents and world are read, and their domain does
// not leave its domain.

/// So many samples per axis (of each coset): the domains are the same. Throws InputError (--dims) for several samples along an axis on which the
/// domain has no length.
TargetGrid grid_of_extents(const Volume& source, LatticeKind lattice, const Extents& extents);

/// Samples `spacing` world units apart along each axis of the Cartesian grid, or of a coset's grid: as many as the domain holds, from its origin on, so
/// that less than `spacing` is left beyond the last one. Throws InputError (--spacing) where a BCC cell, half as long, does not fit in.
TargetGrid grid_of_spacing(const Volume& source, LatticeKind lattice, double spacing);

/// About `count` samples in all, in cells of the shape of the source's. The domains are the same. Cells are e times as long as the source's; a
/// Cartesian lattice has one sample in e^3, the BCC lattice one in 4 e^3: its cells are 4^-1/3 = 0.63 times, a coset's steps 2^1/3 = 1.26 times as long
/// as the steps of a Cartesian grid of as many samples.
TargetGrid grid_of_count(const Volume& source, LatticeKind lattice, std::uint64_t count);

/// The length of the grid's lattice coordinates along each axis, in those of `source`.
glm::dvec3 relative_steps(const TargetGrid& grid, const World& source);

}  // namespace quincunx

// Random rays that look for the surface in what a structure skips.
#pragma once

#include <cstdint>

#include "accel/structure.h"
#include "tests/render/adversarial_volumes.h"

namespace quincunx {

/// What the rays saw.
struct SkippedSpace {
  std::uint64_t rays = 0;       ///< that met the domain
  std::uint64_t stretches = 0;  ///< that were skipped
  std::uint64_t points = 0;     ///< of them that were looked at: both ends and two random ones of each stretch
  std::uint64_t violations = 0;  ///< with a value on the other side of the isovalue than the stretch's first point

  void operator+=(const SkippedSpace& s) { rays += s.rays, stretches += s.stretches, points += s.points, violations += s.violations; }
};

/// Sends `rays` random rays (a multiple of 64) through `v`, skipped as `config` says, in the kernels' own arithmetic: most from
/// anywhere in any direction, some along axes, in lattice planes and through lattice points (from one random eye where a structure is sorted for one). `shrink`: the part by which every
/// cell's bounds are narrowed at both ends before use; 0 for what is certified.
SkippedSpace look_into_skipped_space(const AdversarialVolume& v, const SkipConfig& config, std::uint32_t rays, std::uint32_t seed, double shrink = 0.0);

}  // namespace quincunx

// How far the first hits of a picture are from those of the double-precision reference.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/truth.h"
#include "render/scene.h"

namespace quincunx {

/// Lengths are in cells of lattice coordinates along the ray; angles in degrees.
struct HitErrors {
  std::uint64_t expected = 0;     ///< hits of the reference
  std::uint64_t missed = 0;       ///< the reference hits, the picture does not
  std::uint64_t false_hits = 0;   ///< the picture hits, the reference does not
  std::uint64_t wrong_sheet = 0;  ///< both hit, more than half a cell apart
  /// Over the other hits that both have; 0 where there are none. Depths are 32-bit floats in both, which alone is
  /// half an ulp each: 2^-24 of the distance to the eye.
  double depth_rms = 0.0, depth_p99 = 0.0, normal_rms = 0.0;
  double residual_max = 0.0;  ///< |f - isovalue| / |grad f| in double at the picture's hits, all of them
};

/// Gathers the errors of a setting over several views.
class HitComparison {
 public:
  /// `frame` and `reference` are pictures of `scene`, which has one isosurface.
  void add(const Truth& truth, const Scene& scene, const Frame& frame, const Frame& reference);
  HitErrors errors() const;

 private:
  struct Row {
    HitErrors counts;  ///< and residual_max
    double angle_squares = 0.0;
    std::vector<float> depths;  ///< |error| of each hit that both have
  };
  static Row compare_row(const Truth::Rays& rays, double isovalue, const Frame& frame, const Frame& reference, int j);

  Row total_;
};

}  // namespace quincunx

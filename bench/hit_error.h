// How far the first hits of a picture are from those of the double-precision reference.
#pragma once

#include "bench/frame_error.h"
#include "bench/truth.h"
#include "render/scene.h"

namespace quincunx {

/// Lengths are in cells of lattice coordinates along the ray; angles in degrees. Depths are 32-bit floats in both pictures, which alone is
/// half an ulp each: 2^-24 of the distance to the eye.
struct HitErrors : FrameErrors {
  double residual_max = 0.0;  ///< |f - isovalue| / |grad f| in double at the picture's hits, all of them
};

/// Gathers the errors of a setting over several views.
class HitComparison {
 public:
  /// `frame` and `reference` are pictures of `scene`, which has one isosurface.
  void add(const Truth& truth, const Scene& scene, const Frame& frame, const Frame& reference);
  HitErrors errors() const;

 private:
  FrameComparison frames_;
  double residual_max_ = 0.0;
};

}  // namespace quincunx

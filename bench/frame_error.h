// How far the first hits and the colours of one picture are from those of another.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "render/scene.h"

namespace quincunx {

/// Lengths are in cells along the ray, angles in degrees.
struct FrameErrors {
  std::uint64_t compared = 0;     ///< pixels in which one picture or the other has a hit
  std::uint64_t expected = 0;     ///< hits of the reference
  std::uint64_t missed = 0;       ///< the reference hits, the picture does not
  std::uint64_t false_hits = 0;   ///< the picture hits, the reference does not
  std::uint64_t wrong_sheet = 0;  ///< both hit, more than half a cell apart
  /// Over the other hits that both have; 0 where there are none.
  double depth_rms = 0.0, depth_p99 = 0.0, depth_max = 0.0;
  double normal_rms = 0.0, normal_p99 = 0.0;

  std::uint64_t wrong() const { return missed + false_hits + wrong_sheet; }
  /// Missed, false and wrong first hits, in % of the pixels compared.
  double wrong_percent() const { return compared == 0 ? 0.0 : 100.0 * double(wrong()) / double(compared); }
};

/// Between two vectors of any length, exact for small angles too.
double angle_degrees(const glm::dvec3& a, const glm::dvec3& b);

/// Gathers the errors of pictures.
class FrameComparison {
 public:
  /// The world length along pixel p's ray in which depths are told.
  using CellLength = std::function<double(std::size_t pixel)>;
  /// Whether pixel p counts.
  using Counts = std::function<bool(std::size_t pixel)>;

  /// Both are pictures of one scene. An empty `counts` counts every pixel.
  void add(const Frame& frame, const Frame& reference, const CellLength& cell, const Counts& counts = {});
  FrameErrors errors() const;

 private:
  FrameErrors counts_;
  std::vector<float> depths_, angles_;  ///< |error| of each hit that both have
};

/// Root of the mean square of the differences of colours as a screen shows them (sRGB, 0..1).
double image_rmse(const Frame& a, const Frame& b);

/// The structural similarity of two pictures, 1 where they are the same: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, Image quality
/// assessment: from error visibility to structural similarity, IEEE Transactions on Image Processing 13(4), 2004, DOI 10.1109/TIP.2003.819861,
/// equation 13 over windows of 11 x 11 weighted by a Gaussian of 1.5 pixels, of the luma of sRGB; the mean over all windows
/// inside the picture. Throws std::logic_error for pictures of less than 11 x 11 pixels.
double structural_similarity(const Frame& a, const Frame& b);

}  // namespace quincunx

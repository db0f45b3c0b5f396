// Closed surfaces from many random rays: none that is aimed at their inside may pass through.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lattice/progress.h"

namespace quincunx {

struct WatertightPlan {
  std::vector<std::string> splines;
  std::string device;
  std::uint64_t rays = 1000000;  ///< aimed at the inside, of each surface and spline, at least
  std::uint32_t seed = 1;        ///< of the cameras
  int size = 512;                ///< pixels each way of a camera's picture
};

/// One surface with one spline.
struct WatertightLine {
  std::string surface, spline;
  std::uint64_t rays = 0;   ///< that certainly pass through the inside
  std::uint64_t leaks = 0;  ///< of these, no hit, or one behind a place that is inside
  std::uint64_t hits = 0;   ///< of all rays, aimed or not
  double off = 0.0;         ///< cells: the farthest that a hit is from the analytic surface, to first order: reconstruction error and outliers
  bool passed() const { return leaks == 0 && off < kFarthestHit; }
  static constexpr double kFarthestHit = 0.25;  ///< cells: farther than any of the splines reconstructs these surfaces wrongly
};

/// The surfaces, by name: a sphere, a torus, and a part of a gyroid closed by a ball, of [-1,1]^3 sampled on 64^3 x 2 or 128^3 lattice points.
/// Each is seen by cameras around it at random. A ray is aimed inside where one of 128 places along it has a value well above the isovalue.
std::vector<WatertightLine> measure_watertight(const WatertightPlan& plan, std::string& device, const Progress& progress = {});

}  // namespace quincunx

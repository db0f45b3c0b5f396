// What the bounds of every spline have in common: the form of their margin, 16 bits, and work in tiles.
#pragma once

#include <tbb/parallel_for.h>

#include <cstdint>
#include <mutex>

#include "accel/bounds.h"

namespace quincunx {

constexpr double kBoundsEpsilon = 0x1p-24;
/// Numbers too small for the float format may be flushed to zero; this is 2^16 of the least normal ones.
constexpr double kBoundsTiny = 0x1p-110;

/// How far an interval is widened on either side:
///   per_width * w  +  per_near_width * W  +  per_magnitude * m  +  tiny
/// w the interval's width, W that of the coefficients which reach the cell or one of its 26 neighbours, m the largest |coefficient|
/// of these.
struct Margin {
  double per_width = 0.0, per_near_width = 0.0, per_magnitude = 0.0;
};

/// Whether coefficients are those of a whole volume, beyond whose border its last ones repeat, or of a box cut out, beyond which there
/// may be anything.
enum class Surroundings { border, unknown };

/// Widens the intervals [low[i], high[i]], i < n, by around(i) and rounds them outwards, to every `Stride`th number of the result.
template <int Stride, class Around>
void quantise(const ValueScale& scale, const float* low, const float* high, const Around& around, std::int64_t n,
              std::uint16_t* min, std::uint16_t* max) {
  const double origin = scale.low, step = scale.step, inverse = 1.0 / step;
  for (std::int64_t i = 0; i < n; ++i) {
    const double margin = around(i), least = double(low[i]) - margin, most = double(high[i]) + margin;
    // The quotients may be off by a rounding: compare as the reader computes, and step outwards.
    std::int32_t q = std::int32_t((least - origin) * inverse);
    q -= origin + double(q) * step > least;
    min[Stride * i] = std::uint16_t(q < 0 ? 0 : q);
    q = std::int32_t((most - origin) * inverse);
    q += origin + double(q) * step < most;
    q += origin + double(q) * step < most;
    max[Stride * i] = std::uint16_t(q > 65535 ? 65535 : q);
  }
}

/// Calls tile(n) for 0 <= n < tiles in parallel; tells Progress of finished ones, from one thread at a time.
template <class Tile>
void for_each_tile(std::int64_t tiles, const Progress& progress, const Tile& tile) {
  std::mutex mutex;
  std::int64_t done = 0;
  tbb::parallel_for(std::int64_t(0), tiles, [&](std::int64_t n) {
    tile(n);
    const std::lock_guard lock(mutex);
    ++done;
    report(progress, double(done) / double(tiles));
  });
}

}  // namespace quincunx

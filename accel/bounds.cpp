// Bounds of the bcc7 spline over cells.
//
// On a tetrahedron the spline lies between the least and the largest of its Bernstein coefficients, and those of the
// cell's 6 tetrahedra are the net at the cell's 5^3 quarter-grid points: [lo, hi], w = hi - lo. That interval is
// widened by what 32-bit floats may add. Let e = 2^-24, m the largest |coefficient| that reaches the cell or one of its
// 26 neighbours (magnitude.h), and d the largest 1-norm, in cells, of the distance between a point that a kernel means
// and the one it computes. The margin on either side is
//
//   4 w d  +  24 m d^2  +  K e m  +  tiny
//
// Position. Each axis is an edge direction of every tetrahedron, so a partial derivative is 4 times a difference of two
// neighbouring Bernstein coefficients, at most 4 w in absolute value: to first order a displacement changes the value
// by 4 w d. It may leave the cell. The spline is C2 and its second derivatives are 12 times second differences of the
// net, at most 12 * 2 * (2 m) with the neighbour's width at most 2 m; half of that times d^2 is the rest of Taylor's
// formula. A kernel computes o + t d per axis from numbers rounded once, relative to the volume's middle: with n cells
// along the axis o and the sum err by n e / 2 each, d t and the product by n e each, t (which moves along the ray) by 3
// n e through the exit it comes from: 6 n e an axis. So d = 6 e (nx + ny + nz), and at least 2^-13, which is an error
// of 4e-5 in each axis.
//
// Evaluation. In monomial form about the even corner (32 coefficients from 30 samples, then Horner's rule, arguments in
// [0,1]) the error is at most e times the sum over the operations of their largest results: 111 e m for the
// coefficients, 57 e m for Horner's rule at the far corner, 170 e m together. The 5 Bernstein coefficients along a ray
// from 5 values of the polynomial weigh the values' errors by up to 274/18; on alternating signs, where most cancels,
// those of the coefficients stay below 25 e m (tests/accel/bounds_test.cpp). The net here is computed within 32 e m
// (net_line.h). K = 512 holds each of them with room to spare and costs about one step of the 16 bits. Numbers too
// small for the float format may be flushed to zero: tiny = 2^-110 is 2^16 of the least normal numbers.
//
// Coefficients are supposed to be below 1e36 in absolute value: above, floats overflow in any kernel.
#include "accel/bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>

#include "accel/magnitude.h"
#include "accel/net_line.h"

namespace quincunx {
namespace {

constexpr double kEpsilon = 0x1p-24;
constexpr double kEvaluation = 512.0 * kEpsilon;
constexpr double kTiny = 0x1p-110;
constexpr std::int64_t kTile = 8;  // cells along y and z of a tile; even

/// The margin above as linear functions: margin = per_width * w + per_magnitude * m + kTiny.
struct Margin {
  double per_width, per_magnitude;

  explicit Margin(const glm::i64vec3& cells) {
    const double d = std::max(0x1p-13, 6.0 * kEpsilon * double(cells.x + cells.y + cells.z));
    per_width = 4.0 * d;
    per_magnitude = 24.0 * d * d + kEvaluation;
  }
};

/// The least and the largest coefficient.
struct Range {
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
};

Range coefficient_range(const std::vector<float>& data) {
  using Blocks = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Blocks(0, data.size(), 1 << 16), Range{},
      [&](const Blocks& block, Range r) {
        float low = r.low, high = r.high;
        for (std::size_t n = block.begin(); n != block.end(); ++n) {
          low = data[n] < low ? data[n] : low;
          high = data[n] > high ? data[n] : high;
        }
        return Range{low, high};
      },
      [](const Range& a, const Range& b) {
        return Range{std::min(a.low, b.low), std::max(a.high, b.high)};
      });
}

/// Sets low and step so that value(0) and value(65535) enclose every widened interval: the net's values are means of
/// the coefficients, and the margin grows with width and magnitude.
void set_scale(const Range& range, const Margin& margin, CellBounds& bounds) {
  const double low = range.low, high = range.high, m = std::max(std::abs(low), std::abs(high));
  const double around = margin.per_width * (high - low + 64.0 * kEpsilon * m) +
                        (margin.per_magnitude + 64.0 * kEpsilon) * m + 2.0 * kTiny;
  bounds.low = low - around;
  bounds.step = (high + around - bounds.low) / 65535.0;
  while (bounds.value(65535) < high + around)
    bounds.step = std::nextafter(bounds.step, std::numeric_limits<double>::max());
}

/// Widens the net's range of the cells 2i + parity, i < n, by the margin and rounds it outwards; `magnitude` is indexed
/// by i. Strides of 2 in the result: the other parity comes between.
void quantise(const CellBounds& bounds, const Margin& margin, const float* low, const float* high,
              const float* magnitude, std::int64_t n, std::uint16_t* min, std::uint16_t* max) {
  const double origin = bounds.low, step = bounds.step, inverse = 1.0 / step;
  const double per_width = margin.per_width, per_magnitude = margin.per_magnitude;
  for (std::int64_t i = 0; i < n; ++i) {
    const double lo = low[i], hi = high[i];
    const double around = per_width * (hi - lo) + per_magnitude * double(magnitude[i]) + kTiny;
    const double least = lo - around, most = hi + around;
    // The quotients may be off by a rounding: compare as the reader computes, and step outwards.
    std::int32_t q = std::int32_t((least - origin) * inverse);
    q -= origin + double(q) * step > least;
    min[2 * i] = std::uint16_t(q < 0 ? 0 : q);
    q = std::int32_t((most - origin) * inverse);
    q += origin + double(q) * step < most;
    q += origin + double(q) * step < most;
    max[2 * i] = std::uint16_t(q > 65535 ? 65535 : q);
  }
}

/// What one thread works with.
struct TileWork {
  NetLines::Workspace lines;
  Magnitudes magnitudes;
  std::vector<RowRange> rows;  ///< kTile * kTile of them, y fastest
};

/// Computes the bounds of the rows of cells y0 <= y < y1, z0 <= z < z1.
class Tile {
 public:
  Tile(std::int64_t y0_, std::int64_t z0_, const glm::i64vec3& cells)
      : y0(y0_), z0(z0_), y1(std::min(y0 + kTile, cells.y)), z1(std::min(z0 + kTile, cells.z)) {}

  void compute(const Coefficients<float>& c, const NetLines& net, const Margin& margin, TileWork& work,
               CellBounds& bounds) const {
    for (RowRange& row : work.rows) {
      std::fill(row.min.begin(), row.min.end(), std::numeric_limits<float>::max());
      std::fill(row.max.begin(), row.max.end(), std::numeric_limits<float>::lowest());
    }
    for (std::int64_t z = 4 * z0; z <= 4 * z1; ++z)
      for (std::int64_t y = 4 * y0; y <= 4 * y1; ++y) widen(net, y, z, work);
    const std::int64_t j0 = y0 / 2, k0 = z0 / 2;
    work.magnitudes.compute(c, j0, (y1 + 1) / 2 - j0, k0, (z1 + 1) / 2 - k0);
    for (std::int64_t z = z0; z < z1; ++z)
      for (std::int64_t y = y0; y < y1; ++y) {
        const RowRange& row = work.rows[std::size_t((z - z0) * kTile + (y - y0))];
        const float* m = work.magnitudes.row(y / 2, z / 2);
        const std::size_t first = bounds.number({0, y, z});
        for (std::int64_t parity = 0; parity < 2; ++parity)
          quantise(bounds, margin, row.min.data() + parity * row.pitch, row.max.data() + parity * row.pitch, m,
                   (bounds.cells.x + 1 - parity) / 2, bounds.min.data() + first + parity,
                   bounds.max.data() + first + parity);
      }
  }

 private:
  /// Widens the rows of this tile that the line (y,z), quarter units, touches: 1, 2 or 4.
  void widen(const NetLines& net, std::int64_t y, std::int64_t z, TileWork& work) const {
    RowRange* rows[4];
    int count = 0;
    for (std::int64_t cz = std::max((z + 3) / 4 - 1, z0); cz <= std::min(z / 4, z1 - 1); ++cz)
      for (std::int64_t cy = std::max((y + 3) / 4 - 1, y0); cy <= std::min(y / 4, y1 - 1); ++cy)
        rows[count++] = &work.rows[std::size_t((cz - z0) * kTile + (cy - y0))];
    net.widen(y, z, work.lines, rows, count);
  }

  std::int64_t y0, z0, y1, z1;
};

/// Counts finished tiles and tells Progress, from one thread at a time.
class TileProgress {
 public:
  TileProgress(const Progress& progress, std::int64_t tiles) : progress_(progress), tiles_(tiles) {}
  void finished() {
    const std::lock_guard lock(mutex_);
    ++done_;
    report(progress_, double(done_) / double(tiles_));
  }

 private:
  const Progress& progress_;
  const std::int64_t tiles_;
  std::int64_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace

CellBounds bcc7_bounds(const Coefficients<float>& c, const Progress& progress) {
  assert(c.lattice == LatticeKind::bcc && c.apron >= 1);
  CellBounds bounds;
  bounds.cells = domain_max(c.lattice, c.extents);
  const Margin margin(bounds.cells);
  set_scale(coefficient_range(c.data), margin, bounds);
  const std::size_t count = std::size_t(bounds.cells.x * bounds.cells.y * bounds.cells.z);
  bounds.min.resize(count);
  bounds.max.resize(count);

  const NetLines net(c);
  const std::int64_t tiles_y = (bounds.cells.y + kTile - 1) / kTile, tiles_z = (bounds.cells.z + kTile - 1) / kTile;
  tbb::enumerable_thread_specific<TileWork> works([&] {
    return TileWork{net.workspace(), {}, std::vector<RowRange>(kTile * kTile, net.empty_range())};
  });
  TileProgress finished(progress, tiles_y * tiles_z);
  tbb::parallel_for(std::int64_t(0), tiles_y * tiles_z, [&](std::int64_t t) {
    Tile(t % tiles_y * kTile, t / tiles_y * kTile, bounds.cells).compute(c, net, margin, works.local(), bounds);
    finished.finished();
  });
  return bounds;
}

}  // namespace quincunx

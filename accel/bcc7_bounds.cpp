// Bounds of the bcc7 spline over cells.
//
// The Bernstein coefficients of the cell's 6 tetrahedra are the net at the cell's 5^3 quarter-grid points: [lo, hi],
// w = hi - lo. With e and d of bounds.cpp and m the largest |coefficient| that reaches the cell or one of its 26
// neighbours (magnitude.h), the margin on either side is
//
//   4 w d  +  24 m d^2  +  K e m  +  tiny
//
// Position. Each axis is an edge direction of every tetrahedron, so a partial derivative is 4 times a difference of two
// neighbouring Bernstein coefficients, at most 4 w in absolute value: to first order a displacement changes the value
// by 4 w d. It may leave the cell. The spline is C2 and its second derivatives are 12 times second differences of the
// net, at most 12 * 2 * (2 m) with the neighbour's width at most 2 m; half of that times d^2 is the rest of Taylor's
// formula.
//
// Evaluation. In monomial form about the even corner (32 coefficients from 30 samples, then Horner's rule, arguments in
// [0,1]) the error is at most e times the sum over the operations of their largest results: 111 e m for the
// coefficients, 57 e m for Horner's rule at the far corner, 170 e m together. The 5 Bernstein coefficients along a ray
// from 5 values of the polynomial weigh the values' errors by up to 274/18; on alternating signs, where most cancels,
// those of the coefficients stay below 25 e m (tests/accel/bounds_test.cpp). The net here is computed within 32 e m
// (net_line.h). K = 512 holds each of them with room to spare and costs about one step of the 16 bits.
#include "accel/bcc7_bounds.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "accel/magnitude.h"
#include "accel/net_line.h"

namespace quincunx {
namespace {

constexpr std::int64_t kTile = 8;  // cells along y and z of a tile; even

/// What one thread works with.
struct TileWork {
  NetLines::Workspace lines;
  Magnitudes magnitudes;
  std::vector<RowRange> rows;  ///< kTile * kTile of them, y fastest
};

/// What all tiles share.
struct Task {
  const Coefficients<float>& c;
  const NetLines& net;
  Margin margin;
  std::vector<float> magnitude;  ///< of every i where surroundings are unknown; empty where they are to be looked at
};

/// Computes the bounds of the rows of cells y0 <= y < y1, z0 <= z < z1.
class Tile {
 public:
  Tile(std::int64_t y0_, std::int64_t z0_, const glm::i64vec3& cells)
      : y0(y0_), z0(z0_), y1(std::min(y0 + kTile, cells.y)), z1(std::min(z0 + kTile, cells.z)) {}

  void compute(const Task& task, TileWork& work, CellBounds& bounds) const {
    for (RowRange& row : work.rows) {
      std::fill(row.min.begin(), row.min.end(), std::numeric_limits<float>::max());
      std::fill(row.max.begin(), row.max.end(), std::numeric_limits<float>::lowest());
    }
    for (std::int64_t z = 4 * z0; z <= 4 * z1; ++z)
      for (std::int64_t y = 4 * y0; y <= 4 * y1; ++y) widen(task.net, y, z, work);
    const std::int64_t j0 = y0 / 2, k0 = z0 / 2;
    if (task.magnitude.empty()) work.magnitudes.compute(task.c, j0, (y1 + 1) / 2 - j0, k0, (z1 + 1) / 2 - k0);
    for (std::int64_t z = z0; z < z1; ++z)
      for (std::int64_t y = y0; y < y1; ++y)
        finish(work.rows[std::size_t((z - z0) * kTile + (y - y0))],
               task.magnitude.empty() ? work.magnitudes.row(y / 2, z / 2) : task.magnitude.data(), task.margin,
               bounds.number({0, y, z}), bounds);
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

  /// Widens the ranges of a row of cells by the margin; cells 2i and 2i + 1 have magnitude m[i].
  static void finish(const RowRange& row, const float* m, const Margin& margin, std::size_t first, CellBounds& bounds) {
    for (std::int64_t parity = 0; parity < 2; ++parity) {
      const float *low = row.min.data() + parity * row.pitch, *high = row.max.data() + parity * row.pitch;
      const auto around = [&](std::int64_t i) {
        return margin.per_width * (double(high[i]) - double(low[i])) + margin.per_magnitude * double(m[i]) + kBoundsTiny;
      };
      quantise<2>(bounds, low, high, around, (bounds.cells.x + 1 - parity) / 2, bounds.min.data() + first + parity,
                  bounds.max.data() + first + parity);
    }
  }

  std::int64_t y0, z0, y1, z1;
};

}  // namespace

Margin bcc7_margin(double d) { return {4.0 * d, 0.0, 24.0 * d * d + 512.0 * kBoundsEpsilon}; }

void bcc7_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds) {
  assert(c.lattice == LatticeKind::bcc && c.apron >= 1);
  const NetLines net(c);
  Task task{c, net, bcc7_margin(scale.displacement), {}};
  if (surroundings == Surroundings::unknown) {
    const double m = std::max(std::abs(scale.least), std::abs(scale.most));
    task.magnitude.assign(std::size_t(c.extents.x), std::nextafter(float(m), std::numeric_limits<float>::max()));
  }
  const std::int64_t tiles_y = (bounds.cells.y + kTile - 1) / kTile, tiles_z = (bounds.cells.z + kTile - 1) / kTile;
  tbb::enumerable_thread_specific<TileWork> works([&] {
    return TileWork{net.workspace(), Magnitudes{}, std::vector<RowRange>(kTile * kTile, net.empty_range())};
  });
  for_each_tile(tiles_y * tiles_z, progress, [&](std::int64_t t) {
    Tile(t % tiles_y * kTile, t / tiles_y * kTile, bounds.cells).compute(task, works.local(), bounds);
  });
}

}  // namespace quincunx

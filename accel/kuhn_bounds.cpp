// Bounds of the box splines of the BCC lattice over cells.
//
// The Bernstein coefficients of the cell's 6 tetrahedra are the net at the cell's (n+1)^3 points of the grid (1/n)Z^3, n the degree:
// [lo, hi], w = hi - lo. With e and d of bounds.cpp, m the largest |coefficient| that reaches the cell or one of its 26
// neighbours (magnitude.h), and W the width of the range of these coefficients, the margins on either side are
//
//   bcc4   3 W d                 +   128 e m  +  tiny
//   bcc7   4 w d  +  24 m d^2    +   512 e m  +  tiny
//   bcc8   5 w d  +  40 m d^2    +   512 e m  +  tiny
//
// Position, where the spline is C2. Each axis is an edge direction of every tetrahedron, so a partial derivative is n times a
// difference of two neighbouring Bernstein coefficients, at most n w in absolute value: to first order a displacement changes the
// value by n w d. It may leave the cell. The second derivatives are n (n-1) times second differences of the net, 12 or 20 times at
// most 2 * (2 m) with the neighbour's width at most 2 m; half of that times d^2 is the rest of Taylor's formula.
//
// Position, bcc4. It is linear on a tetrahedron, with slopes that are differences of its values at two vertices, at most W; they jump
// from one tetrahedron to the next, in the cell and beyond. A kernel that means u evaluates at u', within d of u, the polynomial of a
// tetrahedron that has a point q within d of u: from u to q the spline changes by at most W d, from q to u', 2 d away, the polynomial by
// 2 W d.
//
// Evaluation. In monomial form about the even corner (coefficients from the samples, then Horner's rule, arguments in
// [0,1]) the error is at most e times the sum over the operations of their largest results, which tests/spline/piece_tables_test.cpp adds up:
// 16 e m, 132 e m and 230 e m of values. Sums over the operations that lead to the Bernstein coefficients along a ray are up to 31, 1154 and 3129 e m,
// of which nothing is near in fact: on alternating signs, where most cancels, they stay below 4 e m (tests/accel/bounds_test.cpp). The net here is computed within 32 e m (net_line.h). K = 128 and 512 hold each of them with room to
// spare and cost about one step of the 16 bits.
#include "accel/kuhn_bounds.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "accel/magnitude.h"
#include "accel/net_line.h"
#include "spline/bcc4_net.h"
#include "spline/bcc7_net.h"
#include "spline/bcc8_net.h"

namespace quincunx {
namespace {

constexpr std::int64_t kTile = 8;  // cells along y and z of a tile; even

/// What one thread works with.
struct TileWork {
  NetLines::Workspace lines;
  Magnitudes magnitudes;           ///< or, where the margin asks for W, the largest coefficients
  Magnitudes negatives;            ///< then the largest negatives
  std::vector<RowRange> rows;  ///< kTile * kTile of them, y fastest
};

/// What all tiles share.
struct Task {
  const Coefficients<float>& c;
  const NetLines& net;
  std::int64_t degree;
  Magnitudes::Near near;  ///< the samples that reach the neighbours of a pair of cells
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
    for (std::int64_t z = task.degree * z0; z <= task.degree * z1; ++z)
      for (std::int64_t y = task.degree * y0; y <= task.degree * y1; ++y) widen(task, y, z, work);
    look_around(task, work);
    for (std::int64_t z = z0; z < z1; ++z)
      for (std::int64_t y = y0; y < y1; ++y) {
        const RowRange& row = work.rows[std::size_t((z - z0) * kTile + (y - y0))];
        const float* m = task.magnitude.empty() ? work.magnitudes.row(y / 2, z / 2) : task.magnitude.data();
        const float* negative = task.margin.per_near_width > 0.0 ? work.negatives.row(y / 2, z / 2) : nullptr;
        finish(row, m, negative, task.margin, bounds.number({0, y, z}), bounds);
      }
  }

 private:
  /// Widens the rows of this tile that the line (y,z), n-ths, touches: 1, 2 or 4.
  void widen(const Task& task, std::int64_t y, std::int64_t z, TileWork& work) const {
    const std::int64_t n = task.degree;
    RowRange* rows[4];
    int count = 0;
    for (std::int64_t cz = std::max((z + n - 1) / n - 1, z0); cz <= std::min(z / n, z1 - 1); ++cz)
      for (std::int64_t cy = std::max((y + n - 1) / n - 1, y0); cy <= std::min(y / n, y1 - 1); ++cy)
        rows[count++] = &work.rows[std::size_t((cz - z0) * kTile + (cy - y0))];
    task.net.widen(y, z, work.lines, rows, count);
  }

  /// Finds the coefficients near each cell.
  void look_around(const Task& task, TileWork& work) const {
    if (!task.magnitude.empty()) return;
    const std::int64_t j0 = y0 / 2, k0 = z0 / 2, count_j = (y1 + 1) / 2 - j0, count_k = (z1 + 1) / 2 - k0;
    const bool widths = task.margin.per_near_width > 0.0;
    work.magnitudes.compute(task.c, task.near, widths ? Magnitudes::Of::value : Magnitudes::Of::absolute, j0, count_j, k0, count_k);
    if (widths) work.negatives.compute(task.c, task.near, Magnitudes::Of::negative, j0, count_j, k0, count_k);
  }

  /// Widens the ranges of a row of cells by the margin; cells 2i and 2i + 1 have magnitude m[i] or, where `negative` is given, coefficients
  /// from -negative[i] to m[i] near them.
  static void finish(const RowRange& row, const float* m, const float* negative, const Margin& margin, std::size_t first, CellBounds& bounds) {
    for (std::int64_t parity = 0; parity < 2; ++parity) {
      const float *low = row.min.data() + parity * row.pitch, *high = row.max.data() + parity * row.pitch;
      const auto around = [&](std::int64_t i) {
        const double width = negative ? double(m[i]) + double(negative[i]) : 0.0, magnitude = negative ? std::max(m[i], negative[i]) : m[i];
        return margin.per_width * (double(high[i]) - double(low[i])) + margin.per_near_width * width + margin.per_magnitude * magnitude +
               kBoundsTiny;
      };
      quantise<2>(bounds, low, high, around, (bounds.cells.x + 1 - parity) / 2, bounds.min.data() + first + parity,
                  bounds.max.data() + first + parity);
    }
  }

  std::int64_t y0, z0, y1, z1;
};

void kuhn_bounds(const Coefficients<float>& c, const NetView& view, const Magnitudes::Near& near, const Margin& margin, const BoundsScale& scale, Surroundings surroundings,
                 const Progress& progress, CellBounds& bounds) {
  const NetLines net(c, view);
  Task task{c, net, view.degree, near, margin, {}};
  if (surroundings == Surroundings::unknown && margin.per_near_width == 0.0) {
    const double m = std::max(std::abs(scale.least), std::abs(scale.most));
    task.magnitude.assign(std::size_t(c.extents.x), std::nextafter(float(m), std::numeric_limits<float>::max()));
  }
  const std::int64_t tiles_y = (bounds.cells.y + kTile - 1) / kTile, tiles_z = (bounds.cells.z + kTile - 1) / kTile;
  tbb::enumerable_thread_specific<TileWork> works([&] {
    return TileWork{net.workspace(), {}, {}, std::vector<RowRange>(kTile * kTile, net.empty_range())};
  });
  for_each_tile(tiles_y * tiles_z, progress, [&](std::int64_t t) {
    Tile(t % tiles_y * kTile, t / tiles_y * kTile, bounds.cells).compute(task, works.local(), bounds);
  });
}

// A cell X of bcc4, bcc7 and bcc8 is reached from X-1..X+2, X-2..X+3 and X-3..X+4, its neighbours from one further, so the pair of cells 2i and
// 2i + 1 from 2i-2..2i+4, 2i-3..2i+5 and 2i-4..2i+6.
constexpr Magnitudes::Near kBcc4Near = {1, 2}, kBcc7Near = {2, 2}, kBcc8Near = {2, 3};

}  // namespace

Margin bcc4_margin(double d) { return {0.0, 3.0 * d, 128.0 * kBoundsEpsilon}; }

Margin bcc7_margin(double d) { return {4.0 * d, 0.0, 24.0 * d * d + 512.0 * kBoundsEpsilon}; }

Margin bcc8_margin(double d) { return {5.0 * d, 0.0, 40.0 * d * d + 512.0 * kBoundsEpsilon}; }

void bcc4_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds) {
  kuhn_bounds(c, kNetView<kBcc4Net>, kBcc4Near, bcc4_margin(scale.displacement), scale, surroundings, progress, bounds);
}

void bcc7_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds) {
  kuhn_bounds(c, kNetView<kBcc7Net>, kBcc7Near, bcc7_margin(scale.displacement), scale, surroundings, progress, bounds);
}

void bcc8_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress,
                 CellBounds& bounds) {
  kuhn_bounds(c, kNetView<kBcc8Net>, kBcc8Near, bcc8_margin(scale.displacement), scale, surroundings, progress, bounds);
}

}  // namespace quincunx

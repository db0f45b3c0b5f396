// Bounds of the bcc12 spline over cells.
//
// A cell is one piece, half an edge of the cube between 8 samples of either coset. The net is that of the 4^3 tensor Bernstein coefficients of the
// two tricubic polynomials on the cell, halved and added. Along an axis they stand at the thirds of cells; six to a step of a coset, of whose samples
// at -1, 0, 1, 2 steps they are
//
//   (1,4,1,0)/6   (1,8,3,0)/12   (1,14,9,0)/24   (1,23,23,1)/48   (0,9,14,1)/24   (0,3,8,1)/12.
//
// [lo, hi] is the net's range over the cell, w = hi - lo, m the largest |coefficient| that reaches the cell or one of its 26 neighbours
// (magnitude.h), e and d as in bounds.cpp. The margin on either side is
//
//   3 w d  +  2 m d^2  +  512 e m  +  tiny
//
// Position. Partial derivatives on the cell are means of 3 times differences of the net, at most 3 w. The spline is C2. The second derivatives of
// either cubic, per step of its coset, are means of second differences of its coefficients along one axis, or of differences of differences along two,
// at most 4 m, and a quarter of that per cell: m, for their mean too. Half of that, and as much again for polynomials continued by d beyond the cell
// (tensor_bounds.cpp), is below 2 m d^2. What a kernel rounds where it halves the cell's own coordinates, 3 e, is small beside d.
//
// Evaluation. As of the tricubic spline (tensor_bounds.cpp), once for either coset, and halved: 100 e m and 2 e m for their sum. The net here is computed
// within 20 e m.
#include "accel/bcc12_bounds.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "accel/magnitude.h"

namespace quincunx {
namespace {

constexpr std::int64_t kTile = 8;              // cells along y and z of a tile; even
constexpr std::int64_t kRows = kTile / 2 + 4;  // of samples of a coset that reach a tile
constexpr std::int64_t kThirds = 6;            // of cells, in a step of a coset
constexpr Magnitudes::Near kNear{2, 3};  // a cell is reached from X-3..X+4, a pair and its neighbours from 2i-4..2i+6

/// The weights of the net's points along an axis, of 4 samples each.
struct Weights {
  float a, b, c, d;
};
constexpr Weights kNet[kThirds] = {{8 / 48.f, 32 / 48.f, 8 / 48.f, 0.f}, {4 / 48.f, 32 / 48.f, 12 / 48.f, 0.f},
                                   {2 / 48.f, 28 / 48.f, 18 / 48.f, 0.f}, {1 / 48.f, 23 / 48.f, 23 / 48.f, 1 / 48.f},
                                   {0.f, 18 / 48.f, 28 / 48.f, 2 / 48.f}, {0.f, 12 / 48.f, 32 / 48.f, 4 / 48.f}};

/// A point of the net along an axis, in thirds of cells, as a coset sees it: the sample at or before it, and its place among six.
struct NetPoint {
  std::int64_t index, place;

  NetPoint(std::int64_t thirds, int coset) : index((thirds + kThirds - 3 * coset) / kThirds - 1), place((thirds + kThirds - 3 * coset) % kThirds) {}
};

/// The ranges of a row of cells, even ones and odd ones.
struct RowRange {
  std::vector<float> low[2], high[2];
};

/// What one thread works with. Lines of samples begin two before the volume and end two behind it.
struct TileWork {
  std::vector<float> plane[2];                  ///< of either coset, combined along z: the rows that reach the tile
  std::vector<float> line[2];                   ///< and along y
  std::array<std::vector<float>, kThirds> net;  ///< and along x, of both cosets: point 6 i + n is number i of net[n]
  RowRange ranges;                              ///< of that line
  std::array<RowRange, kTile * kTile> rows;     ///< y fastest
  Magnitudes magnitudes;
};

/// to[i] = the combination of four rows, those `stride` apart from `from` on.
void combine(const Weights& w, const float* from, std::int64_t stride, std::int64_t n, float* to) {
  const float *a = from, *b = a + stride, *c = b + stride, *d = c + stride;
  for (std::int64_t i = 0; i < n; ++i) to[i] = (w.a * a[i] + w.d * d[i]) + (w.b * b[i] + w.c * c[i]);
}

/// The least or the largest of the net over the even cells and the odd ones.
template <class Pick>
void range_cells(const std::array<std::vector<float>, kThirds>& net, std::int64_t n, const Pick& pick, std::vector<float> (&out)[2]) {
  const float *a = net[0].data(), *b = net[1].data(), *c = net[2].data(), *d = net[3].data(), *e = net[4].data(), *f = net[5].data();
  for (std::int64_t i = 0; i < n; ++i) out[0][std::size_t(i)] = pick(pick(a[i], b[i]), pick(c[i], d[i]));
  for (std::int64_t i = 0; i + 1 < n; ++i) out[1][std::size_t(i)] = pick(pick(d[i], e[i]), pick(f[i], a[i + 1]));
}

constexpr auto kLess = [](float a, float b) { return a < b ? a : b; };
constexpr auto kMore = [](float a, float b) { return a > b ? a : b; };

/// What all tiles share.
struct Task {
  const Coefficients<float>& c;
  Margin margin;
  std::vector<float> magnitude;  ///< of every i where surroundings are unknown; empty where they are to be looked at
};

/// The rows of cells y0 <= y < y1, z0 <= z < z1.
class Tile {
 public:
  Tile(const Task& task, std::int64_t y0, std::int64_t z0, const glm::i64vec3& cells)
      : task_(task), n_(task.c.extents.x), y0_(y0), z0_(z0), y1_(std::min(y0 + kTile, cells.y)), z1_(std::min(z0 + kTile, cells.z)) {}

  void compute(TileWork& work, CellBounds& bounds) const {
    prepare(work);
    for (std::int64_t z = 3 * z0_; z <= 3 * z1_; ++z) {
      for (int coset = 0; coset < 2; ++coset) combine_rows(work, coset, z);
      for (std::int64_t y = 3 * y0_; y <= 3 * y1_; ++y) {
        make_net(work, y);
        range_cells(work.net, n_, kLess, work.ranges.low);
        range_cells(work.net, n_, kMore, work.ranges.high);
        widen_rows(work, y, z);
      }
    }
    const std::int64_t j0 = y0_ / 2, k0 = z0_ / 2;
    if (task_.magnitude.empty()) work.magnitudes.compute(task_.c, kNear, Magnitudes::Of::absolute, j0, (y1_ + 1) / 2 - j0, k0, (z1_ + 1) / 2 - k0);
    for (std::int64_t z = z0_; z < z1_; ++z)
      for (std::int64_t y = y0_; y < y1_; ++y)
        finish(row_of(work, y, z), task_.magnitude.empty() ? work.magnitudes.row(y / 2, z / 2) : task_.magnitude.data(), bounds.number({0, y, z}), bounds);
  }

 private:
  std::int64_t width() const { return n_ + 4; }
  RowRange& row_of(TileWork& work, std::int64_t y, std::int64_t z) const { return work.rows[std::size_t((z - z0_) * kTile + (y - y0_))]; }
  std::int64_t first_row(int coset) const { return NetPoint(3 * y0_, coset).index - 1; }

  void prepare(TileWork& work) const {
    for (int coset = 0; coset < 2; ++coset) {
      work.plane[coset].resize(std::size_t(kRows * width()));
      work.line[coset].resize(std::size_t(width()));
    }
    for (std::vector<float>& points : work.net) points.resize(std::size_t(n_));
    const auto clear = [this](RowRange& row) {
      for (int parity = 0; parity < 2; ++parity) {
        row.low[parity].assign(std::size_t(n_), std::numeric_limits<float>::max());
        row.high[parity].assign(std::size_t(n_), std::numeric_limits<float>::lowest());
      }
    };
    clear(work.ranges);
    for (RowRange& row : work.rows) clear(row);
  }

  /// work.plane[coset] at z, thirds of cells.
  void combine_rows(TileWork& work, int coset, std::int64_t z) const {
    const Coefficients<float>& c = task_.c;
    const NetPoint at(z, coset);
    const std::int64_t first = first_row(coset), last = NetPoint(3 * y1_, coset).index + 2;
    for (std::int64_t j = first; j <= last; ++j)
      combine(kNet[at.place], c.data.data() + c.number(coset, {-2, j, at.index - 1}), c.stride_z(), width(), work.plane[coset].data() + (j - first) * width());
  }

  /// work.net at y, thirds of cells.
  void make_net(TileWork& work, std::int64_t y) const {
    for (int coset = 0; coset < 2; ++coset) {
      const NetPoint at(y, coset);
      combine(kNet[at.place], work.plane[coset].data() + (at.index - 1 - first_row(coset)) * width(), width(), width(), work.line[coset].data());
    }
    for (std::int64_t n = 0; n < kThirds; ++n) {
      // Point 6 i + n lies behind the even sample i, and behind the odd sample i - 1 in the first half of the step, i in the second.
      const float *even = work.line[0].data() + 1, *odd = work.line[1].data() + (n < 3 ? 0 : 1);
      const Weights v = kNet[n], w = kNet[(n + 3) % kThirds];
      float* to = work.net[std::size_t(n)].data();
      for (std::int64_t i = 0; i < n_; ++i) {
        const float a = (v.a * even[i] + v.d * even[i + 3]) + (v.b * even[i + 1] + v.c * even[i + 2]);
        const float b = (w.a * odd[i] + w.d * odd[i + 3]) + (w.b * odd[i + 1] + w.c * odd[i + 2]);
        to[i] = 0.5f * (a + b);
      }
    }
  }

  /// Widens the rows of cells that touch the net's line (y,z): 1, 2 or 4.
  void widen_rows(TileWork& work, std::int64_t y, std::int64_t z) const {
    for (std::int64_t cz = std::max((z + 2) / 3 - 1, z0_); cz <= std::min(z / 3, z1_ - 1); ++cz)
      for (std::int64_t cy = std::max((y + 2) / 3 - 1, y0_); cy <= std::min(y / 3, y1_ - 1); ++cy) {
        RowRange& row = row_of(work, cy, cz);
        for (int parity = 0; parity < 2; ++parity) {
          widen(work.ranges.low[parity], kLess, row.low[parity]);
          widen(work.ranges.high[parity], kMore, row.high[parity]);
        }
      }
  }
  template <class Pick>
  void widen(const std::vector<float>& from, const Pick& pick, std::vector<float>& to) const {
    const float* a = from.data();
    float* b = to.data();
    for (std::int64_t i = 0; i < n_; ++i) b[i] = pick(a[i], b[i]);
  }

  /// Widens the ranges of a row of cells by the margin; cells 2i and 2i + 1 have magnitude m[i].
  void finish(const RowRange& row, const float* m, std::size_t first, CellBounds& bounds) const {
    for (std::int64_t parity = 0; parity < 2; ++parity) {
      const float *low = row.low[parity].data(), *high = row.high[parity].data();
      const auto around = [&](std::int64_t i) {
        return task_.margin.per_width * (double(high[i]) - double(low[i])) + task_.margin.per_magnitude * double(m[i]) + kBoundsTiny;
      };
      quantise<2>(bounds, low, high, around, (bounds.cells.x + 1 - parity) / 2, bounds.min.data() + first + parity, bounds.max.data() + first + parity);
    }
  }

  const Task& task_;
  std::int64_t n_, y0_, z0_, y1_, z1_;
};

}  // namespace

Margin bcc12_margin(double d) { return {3.0 * d, 0.0, 2.0 * d * d + 512.0 * kBoundsEpsilon}; }

void bcc12_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress, CellBounds& bounds) {
  assert(c.lattice == LatticeKind::bcc && c.apron == 2);
  Task task{c, bcc12_margin(scale.displacement), {}};
  if (surroundings == Surroundings::unknown) {
    const double m = std::max(std::abs(scale.least), std::abs(scale.most));
    task.magnitude.assign(std::size_t(c.extents.x), std::nextafter(float(m), std::numeric_limits<float>::max()));
  }
  const std::int64_t tiles_y = (bounds.cells.y + kTile - 1) / kTile, tiles_z = (bounds.cells.z + kTile - 1) / kTile;
  tbb::enumerable_thread_specific<TileWork> works;
  for_each_tile(tiles_y * tiles_z, progress, [&](std::int64_t t) {
    Tile(task, t % tiles_y * kTile, t / tiles_y * kTile, bounds.cells).compute(works.local(), bounds);
  });
}

}  // namespace quincunx

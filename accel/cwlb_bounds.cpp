// Bounds of the cosine-weighted linear B-spline over cells.
//
// On a cell the trilinear interpolants of both cosets are polynomials of degree 1 in each coordinate, so each lies between its values at the
// cell's 8 corners, which are means of 1, 2, 4 or 8 samples; and the spline, a f0 + (1 - a) f1 with 0 <= a <= 1, between the least and the largest
// of these 16: [lo, hi]. W is the width of the range of the samples that reach the cell or one of its 26 neighbours, m the largest |sample| among
// these; e and d as in bounds.cpp. The margin on either side is
//
//   1.03 (1 + 2d)^2 W d  +  256 e m  +  tiny
//
// Position. The ray's place in a cell's own coordinates is wrong by d, and may so be taken inside the neighbour where a value of the common face is
// meant, or outside of the cell that is evaluated, whose piece goes on there. A partial derivative is a mean of those of f0 and f1, weighted by
// a, and a's own times f0 - f1. The former are means of differences of samples 2 apart, W/2 at most, the latter (pi/6) W: 1.0236 W together. Beyond
// the cell by d, weights of the other two axes add up to 1 + 2d each at most. Slopes jump from cell to cell, so the neighbours' count, hence W.
//
// Evaluation. The kernel (shaders/cwlb.glsl) subtracts an isovalue, whose absolute value may be taken as at most 2 m, as in tensor_bounds.cpp:
// 3 e m. Each of three steps of linear interpolation passes on a mean of its arguments' errors and adds 7 e m; (1 - u)/2 is wrong by e/2, times
// a difference of 2 m, on three axes 3 e m. The series of a sine is summed within 6 e, a within 6 e, times f0 - f1 of at most 2 m: 12 e m; the last
// interpolation adds 7 e m. Together 46 e m. The corners' values here are within 3 e m. 256 holds five times these.
#include "accel/cwlb_bounds.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace quincunx {
namespace {

/// A row of ranges.
struct Ranges {
  std::vector<float> low, high;

  void clear(std::size_t n) {
    low.assign(n, std::numeric_limits<float>::max());
    high.assign(n, std::numeric_limits<float>::lowest());
  }
  void widen(const float* values, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) low[i] = values[i] < low[i] ? values[i] : low[i];
    for (std::size_t i = 0; i < n; ++i) high[i] = values[i] > high[i] ? values[i] : high[i];
  }
  /// Each of the first n becomes the range of `count` from it on.
  void window(std::size_t n, std::size_t count) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 1; k < count; ++k) low[i] = std::min(low[i], low[i + k]), high[i] = std::max(high[i], high[i + k]);
  }
};

/// What one thread works with.
struct Workspace {
  std::vector<float> row, line;
  Ranges corners, near;
};

/// Rows of cells of one volume.
class Rows {
 public:
  Rows(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Margin& margin)
      : c_(c), margin_(margin), unknown_(surroundings == Surroundings::unknown),
        least_(std::nextafter(float(scale.least), std::numeric_limits<float>::lowest())),
        most_(std::nextafter(float(scale.most), std::numeric_limits<float>::max())) {}

  /// The four rows y = 2j, 2j + 1, z = 2k, 2k + 1, as far as there are.
  void compute(std::int64_t j, std::int64_t k, Workspace& work, CellBounds& bounds) const {
    range_near(j, k, work);
    for (std::int64_t z = 2 * k; z < std::min(2 * k + 2, bounds.cells.z); ++z)
      for (std::int64_t y = 2 * j; y < std::min(2 * j + 2, bounds.cells.y); ++y) {
        range_corners(y, z, bounds.cells.x, work);
        finish(y, z, work, bounds);
      }
  }

 private:
  /// work.near[i]: the samples near the cells 2i and 2i + 1, i - 1 .. i + 2 of either coset along each axis; j and k alike. Beyond the extents the
  /// border repeats.
  void range_near(std::int64_t j, std::int64_t k, Workspace& work) const {
    const std::int64_t n = c_.extents.x;
    const auto beyond = [](std::int64_t i, std::int64_t extent) { return i - 1 < 0 || i + 2 >= extent; };
    work.near.clear(std::size_t(n + 3));
    for (int coset = 0; coset < 2; ++coset)
      for (std::int64_t kk = std::max<std::int64_t>(k - 1, 0); kk <= std::min(k + 2, c_.extents.z - 1); ++kk)
        for (std::int64_t jj = std::max<std::int64_t>(j - 1, 0); jj <= std::min(j + 2, c_.extents.y - 1); ++jj) {
          const float* row = c_.data.data() + c_.number(coset, {0, jj, kk});
          work.row.assign(std::size_t(n + 3), row[n - 1]);
          work.row[0] = row[0];
          std::copy_n(row, n, work.row.begin() + 1);
          work.near.widen(work.row.data(), work.row.size());
        }
    work.near.window(std::size_t(n), 4);
    if (!unknown_) return;
    const bool all = beyond(j, c_.extents.y) || beyond(k, c_.extents.z);
    for (std::int64_t i = 0; i < n; ++i)
      if (all || beyond(i, n)) work.near.low[std::size_t(i)] = least_, work.near.high[std::size_t(i)] = most_;
  }

  /// A coset's interpolant at the lattice points (0 .. cells, y, z), in work.line.
  void interpolate(int coset, std::int64_t y, std::int64_t z, std::int64_t cells, Workspace& work) const {
    const auto below = [coset](std::int64_t p) { return (p - coset) >> 1; };
    const auto between = [coset](std::int64_t p) { return ((p - coset) & 1) != 0; };
    const std::int64_t n = c_.extents.x + 2;  // from -1 on
    const auto row = [&](std::int64_t dj, std::int64_t dk) { return c_.data.data() + c_.number(coset, {-1, below(y) + dj, below(z) + dk}); };
    work.row.assign(std::size_t(n), 0.0f);
    const int rows_y = between(y) ? 2 : 1, rows_z = between(z) ? 2 : 1;
    const float part = 1.0f / float(rows_y * rows_z);
    for (int dk = 0; dk < rows_z; ++dk)
      for (int dj = 0; dj < rows_y; ++dj) {
        const float* from = row(dj, dk);
        for (std::int64_t i = 0; i < n; ++i) work.row[std::size_t(i)] += part * from[i];
      }
    work.line.resize(std::size_t(cells + 1));
    for (std::int64_t x = 0; x <= cells; ++x) {
      const std::size_t i = std::size_t(below(x) + 1);
      work.line[std::size_t(x)] = between(x) ? 0.5f * work.row[i] + 0.5f * work.row[i + 1] : work.row[i];
    }
  }

  /// work.corners: the range of both interpolants at the corners of the cells of the row (y,z).
  void range_corners(std::int64_t y, std::int64_t z, std::int64_t cells, Workspace& work) const {
    work.corners.clear(std::size_t(cells + 1));
    for (std::int64_t dz = 0; dz < 2; ++dz)
      for (std::int64_t dy = 0; dy < 2; ++dy)
        for (int coset = 0; coset < 2; ++coset) {
          interpolate(coset, y + dy, z + dz, cells, work);
          work.corners.widen(work.line.data(), work.line.size());
        }
    work.corners.window(std::size_t(cells), 2);
  }

  void finish(std::int64_t y, std::int64_t z, const Workspace& work, CellBounds& bounds) const {
    const auto around = [&](std::int64_t x) {
      const double least = work.near.low[std::size_t(x / 2)], most = work.near.high[std::size_t(x / 2)];
      return margin_.per_near_width * (most - least) + margin_.per_magnitude * std::max(most, -least) + kBoundsTiny;
    };
    const std::size_t first = bounds.number({0, y, z});
    quantise<1>(bounds, work.corners.low.data(), work.corners.high.data(), around, bounds.cells.x, bounds.min.data() + first, bounds.max.data() + first);
  }

  const Coefficients<float>& c_;
  Margin margin_;
  bool unknown_;
  float least_, most_;  ///< that may be beyond the box
};

}  // namespace

Margin cwlb_margin(double d) { return {0.0, 1.03 * d * (1.0 + 2.0 * d) * (1.0 + 2.0 * d), 256.0 * kBoundsEpsilon}; }

void cwlb_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings, const Progress& progress, CellBounds& bounds) {
  assert(c.lattice == LatticeKind::bcc && c.apron >= 1);
  const Rows rows(c, scale, surroundings, cwlb_margin(scale.displacement));
  tbb::enumerable_thread_specific<Workspace> works;
  for_each_tile(c.extents.y * c.extents.z, progress, [&](std::int64_t n) { rows.compute(n % c.extents.y, n / c.extents.y, works.local(), bounds); });
}

}  // namespace quincunx

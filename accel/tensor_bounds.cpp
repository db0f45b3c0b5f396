// Bounds of the splines that are products along the axes of a Cartesian lattice, over cells.
//
// A cell's net is that of tensor Bernstein coefficients, of its one piece or of its eight: the 8 samples at its corners; of
// the tricubic spline 4^3, made along one axis after the other by
//
//   (c0 + 4 c1 + c2)/6   (2 c1 + c2)/3   (c1 + 2 c2)/3   (c1 + 4 c2 + c3)/6
//
// from the 4 coefficients that reach the cell; of the triquadratic one, whose pieces meet in the cell's middle, 5^3 by
//
//   (c0 + 6 c1 + c2)/8   (3 c1 + c2)/4   (c1 + c2)/2   (c1 + 3 c2)/4   (c1 + 6 c2 + c3)/8
//
// and of the Catmull-Rom spline 4^3 by
//
//   c1   c1 + (c2 - c0)/6   c2 - (c3 - c1)/6   c2.
//
// The last of them is the first of the next cell, so nets are rows of 1, 3 or 4 points a cell. [lo, hi] is the net's
// range over the cell, w = hi - lo; W is the width of the range of the coefficients that reach the cell or one of its
// 26 neighbours, m the largest |coefficient| among these; e and d as in bounds.cpp. The margins on either side are
//
//   trilinear      (1 + 2d)^2 W d              +  256 e m  +  tiny
//   triquadratic   4 w d  +   4 W d^2          +  256 e m  +  tiny
//   tricubic       3 w d  +  16 W d^2          +  512 e m  +  tiny
//   catmull-rom    3 w d  +  24 W d^2          +  512 e m  +  tiny
//
// Position. The ray's place in a cell's own coordinates is wrong by d, and may so be taken inside the neighbour where a
// value of the common face is meant, or outside of the cell that is evaluated, whose polynomial goes on there. A partial
// derivative of the trilinear polynomial is a mean of differences of the samples along an edge, at most W in absolute
// value; beyond the cell by d, weights of the other two axes add up to 1 + 2d each. It jumps from cell to cell, so the
// neighbours' slopes count, hence W and not w. The tricubic spline is C2: its partial derivatives on the cell are means
// of 3 times differences of the net, at most 3 w; the second ones, 6 times second differences along one axis and 9 times
// mixed ones along two, are at most 18 W there and in the neighbours, and half of that times d^2 is the rest of Taylor's
// formula. Beyond the cell by d polynomials of degree 9 grow by less than (1 + 2d)^9: 16 in place of 9 holds
// until d = 1/32, which is 87,000 cells along the three axes together.
// The triquadratic spline is C1, so to first order a displacement across a plane between pieces changes the value as one inside a piece
// does: partial derivatives are 2 / (1/2) times differences of the net, at most 4 w. Second ones jump, and count as the largest of either
// side: c0 - 2 c1 + c2 along one axis, and means of differences of differences along two, at most 2 W; half of that, and as much again for
// polynomials of degree 6 continued by d beyond their piece, is below 4 W d^2.
// The Catmull-Rom spline is C1 too. Its net weighs samples by up to 4/3 along an axis, absolute values added. Second derivatives, 6 times second
// differences, weigh them by 2 there: 6 * 2/2 * (4/3)^2 W < 11 W; mixed ones are 9 times differences of differences, by 2 along two axes:
// 9 * 4/2 * 4/3 W = 24 W. Half of that, and as much again for the polynomials' growth beyond the cell, is 24 W d^2.
//
// Evaluation. The kernels (shaders/trilinear.glsl, shaders/tricubic.glsl) subtract an isovalue, whose absolute value may
// be taken as at most 2 m: beyond, the sign is safe. Each step of linear interpolation a + t (b - a) passes on a mean of
// its arguments' errors and adds 2 e m for the difference and its product each and 3 e m for the sum: from samples to a
// Bernstein coefficient along a segment, six such steps, 3 e m for the isovalue, 15 e m for the mean of three at the end:
// 60 e m. The tricubic weights of one axis, 6 times too large, are wrong by up to 90 e in 18 where they are Bernstein
// coefficients: 20 e over the four samples. Three axes make 60 e m, products and sums of 4, 4 and 16 terms 30 e m, scale
// and isovalue 10 e m: 100 e m. The triquadratic ones, twice too large, are wrong by up to 8 e in 2: 4 e an axis, and with
// sums of 3, 3 and 9 terms it is 50 e m. Those of Catmull-Rom, twice too large, are wrong by up to 30 e in 6: 10 e an axis,
// times (4/3)^2, and sums reach (4/3)^3 m: 150 e m. The net here is computed within 16 e m. 256 and 512 hold twice to five times these.
#include "accel/tensor_bounds.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace quincunx {
namespace {

constexpr std::int64_t kTile = 8;    // cells along y and z of a tile
constexpr std::int64_t kLong = 128;  // and along x
constexpr std::int64_t kRow = kLong + 5;  // samples that reach a row of cells or its neighbours

using Line = std::array<float, kRow>;
/// A row of ranges.
struct Ranges {
  Line low, high;

  void clear() {
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
  }
  /// Widens the first n by those of `other`.
  void widen(const Ranges& other, std::int64_t n) {
    for (std::int64_t i = 0; i < n; ++i) low[i] = other.low[i] < low[i] ? other.low[i] : low[i];
    for (std::int64_t i = 0; i < n; ++i) high[i] = other.high[i] > high[i] ? other.high[i] : high[i];
  }
};

/// The weights of one of a net's points in a cell, of the samples -1, 0, 1 relative to the cell's lower corner or, shifted, 0, 1, 2.
struct Point {
  int first;  ///< -1 or 0
  float weights[3];
};

/// Linear B-splines: the net is the samples.
struct Linear {
  static constexpr std::int64_t kPoints = 1;  ///< of the net, a cell
  static constexpr std::int64_t kBefore = 0;  ///< samples before a cell that reach it, and after it
  static constexpr Point kPointOf[kPoints] = {{0, {1.0f, 0.0f, 0.0f}}};

  /// The ranges over n cells of the line whose samples from the first cell's lower corner are v.
  static void range(const float* v, std::int64_t n, Ranges& ranges) {
    for (std::int64_t i = 0; i < n; ++i) ranges.low[i] = v[i] < v[i + 1] ? v[i] : v[i + 1];
    for (std::int64_t i = 0; i < n; ++i) ranges.high[i] = v[i] > v[i + 1] ? v[i] : v[i + 1];
  }
};

struct Quadratic {
  static constexpr std::int64_t kPoints = 4;
  static constexpr std::int64_t kBefore = 1;
  static constexpr Point kPointOf[kPoints] = {{-1, {1.0f / 8.0f, 6.0f / 8.0f, 1.0f / 8.0f}},
                                              {0, {3.0f / 4.0f, 1.0f / 4.0f, 0.0f}},
                                              {0, {1.0f / 2.0f, 1.0f / 2.0f, 0.0f}},
                                              {0, {1.0f / 4.0f, 3.0f / 4.0f, 0.0f}}};

  /// v begins one sample before the first cell's lower corner. The middle one of the five lies between its neighbours.
  static void range(const float* v, std::int64_t n, Ranges& ranges) {
    Line corner;
    for (std::int64_t i = 0; i <= n; ++i) corner[i] = 0.125f * (v[i] + v[i + 2]) + 0.75f * v[i + 1];
    const auto between = [&](std::int64_t i, const auto& pick) {
      const float a = 0.75f * v[i + 1] + 0.25f * v[i + 2], b = 0.25f * v[i + 1] + 0.75f * v[i + 2];
      return pick(pick(a, b), pick(corner[i], corner[i + 1]));
    };
    for (std::int64_t i = 0; i < n; ++i) ranges.low[i] = between(i, [](float a, float b) { return a < b ? a : b; });
    for (std::int64_t i = 0; i < n; ++i) ranges.high[i] = between(i, [](float a, float b) { return a > b ? a : b; });
  }
};

struct Cubic {
  static constexpr std::int64_t kPoints = 3;
  static constexpr std::int64_t kBefore = 1;
  static constexpr Point kPointOf[kPoints] = {{-1, {1.0f / 6.0f, 4.0f / 6.0f, 1.0f / 6.0f}},
                                              {0, {2.0f / 3.0f, 1.0f / 3.0f, 0.0f}},
                                              {0, {1.0f / 3.0f, 2.0f / 3.0f, 0.0f}}};

  /// v begins one sample before the first cell's lower corner.
  static void range(const float* v, std::int64_t n, Ranges& ranges) {
    Line corner;
    for (std::int64_t i = 0; i <= n; ++i) corner[i] = (1.0f / 6.0f) * (v[i] + v[i + 2]) + (4.0f / 6.0f) * v[i + 1];
    const auto between = [&](std::int64_t i, const auto& pick) {
      const float a = (2.0f / 3.0f) * v[i + 1] + (1.0f / 3.0f) * v[i + 2];
      const float b = (1.0f / 3.0f) * v[i + 1] + (2.0f / 3.0f) * v[i + 2];
      return pick(pick(a, b), pick(corner[i], corner[i + 1]));
    };
    for (std::int64_t i = 0; i < n; ++i) ranges.low[i] = between(i, [](float a, float b) { return a < b ? a : b; });
    for (std::int64_t i = 0; i < n; ++i) ranges.high[i] = between(i, [](float a, float b) { return a > b ? a : b; });
  }
};

struct CatmullRom {
  static constexpr std::int64_t kPoints = 3;
  static constexpr std::int64_t kBefore = 1;
  static constexpr Point kPointOf[kPoints] = {
      {0, {1.0f, 0.0f, 0.0f}}, {-1, {-1.0f / 6.0f, 1.0f, 1.0f / 6.0f}}, {0, {1.0f / 6.0f, 1.0f, -1.0f / 6.0f}}};

  /// v begins one sample before the first cell's lower corner.
  static void range(const float* v, std::int64_t n, Ranges& ranges) {
    const auto between = [&](std::int64_t i, const auto& pick) {
      const float a = v[i + 1] + (1.0f / 6.0f) * (v[i + 2] - v[i]), b = v[i + 2] - (1.0f / 6.0f) * (v[i + 3] - v[i + 1]);
      return pick(pick(a, b), pick(v[i + 1], v[i + 2]));
    };
    for (std::int64_t i = 0; i < n; ++i) ranges.low[i] = between(i, [](float a, float b) { return a < b ? a : b; });
    for (std::int64_t i = 0; i < n; ++i) ranges.high[i] = between(i, [](float a, float b) { return a > b ? a : b; });
  }
};

/// to[i] = the combination of three rows, those `stride` floats apart from `from` on. Rows of weight 0 are not read.
void combine(const Point& point, const float* from, std::int64_t stride, std::int64_t n, float* to) {
  const float *a = from + point.first * stride, *b = a + stride, *c = b + stride;
  const float p = point.weights[0], q = point.weights[1], r = point.weights[2];
  if (q == 0.0f) {
    std::copy_n(a, n, to);
  } else if (r == 0.0f) {
    for (std::int64_t i = 0; i < n; ++i) to[i] = p * a[i] + q * b[i];
  } else if (p == r) {
    for (std::int64_t i = 0; i < n; ++i) to[i] = p * (a[i] + c[i]) + q * b[i];
  } else {
    for (std::int64_t i = 0; i < n; ++i) to[i] = p * a[i] + q * b[i] + r * c[i];
  }
}

/// What one thread works with.
struct TileWork {
  std::array<float, (kTile + 3) * kRow> plane;  ///< rows of samples combined along z, from y0 - kBefore on
  std::array<Ranges, kTile * kTile> net;        ///< over the cells, y fastest
  std::array<Ranges, kTile * kTile> near;       ///< of the coefficients about them
  std::array<Ranges, kTile> near_in_plane;      ///< the same, of one plane z of coefficients
};

/// The cells low <= cell < high.
template <class Net>
class Tile {
 public:
  Tile(const Coefficients<float>& c, const glm::i64vec3& low, const glm::i64vec3& high)
      : c_(c), low_(low), high_(high), size_(high - low) {}

  void compute(const Margin& margin, const BoundsScale& scale, Surroundings surroundings, TileWork& work,
               CellBounds& bounds) const {
    for (Ranges& row : work.net) row.clear();
    for (Ranges& row : work.near) row.clear();
    range_nets(work);
    range_coefficients(work);
    if (surroundings == Surroundings::unknown) widen_at_the_ends(scale, work);
    for (std::int64_t z = 0; z < size_.z; ++z)
      for (std::int64_t y = 0; y < size_.y; ++y) finish(work, y, z, margin, bounds);
  }

 private:
  /// Coefficients before a cell that reach one of its neighbours, and after it.
  static constexpr std::int64_t kNear = Net::kBefore + 1;

  static Ranges& at(std::array<Ranges, kTile * kTile>& rows, std::int64_t y, std::int64_t z) {
    return rows[std::size_t(z * kTile + y)];
  }

  /// work.net from the net's lines along x.
  void range_nets(TileWork& work) const {
    const std::int64_t before = Net::kBefore, count = size_.x + 1 + 2 * before, rows = size_.y + 1 + 2 * before;
    Line line;
    Ranges ranges;
    for (std::int64_t z = 0; z <= Net::kPoints * size_.z; ++z) {
      const Point& along_z = Net::kPointOf[z % Net::kPoints];
      for (std::int64_t j = 0; j < rows; ++j)
        combine(along_z, c_.data.data() + c_.number(0, low_ + glm::i64vec3(-before, j - before, z / Net::kPoints)), c_.stride_z(),
                count, work.plane.data() + j * kRow);
      for (std::int64_t y = 0; y <= Net::kPoints * size_.y; ++y) {
        combine(Net::kPointOf[y % Net::kPoints], work.plane.data() + (y / Net::kPoints + before) * kRow, kRow, count, line.data());
        Net::range(line.data(), size_.x, ranges);
        widen_rows(work, y, z, ranges);
      }
    }
  }

  /// Widens the rows of cells that touch the net's line (y,z): 1, 2 or 4.
  void widen_rows(TileWork& work, std::int64_t y, std::int64_t z, const Ranges& ranges) const {
    const auto first = [](std::int64_t p) { return std::max<std::int64_t>((p + Net::kPoints - 1) / Net::kPoints - 1, 0); };
    for (std::int64_t cz = first(z); cz <= std::min(z / Net::kPoints, size_.z - 1); ++cz)
      for (std::int64_t cy = first(y); cy <= std::min(y / Net::kPoints, size_.y - 1); ++cy)
        at(work.net, cy, cz).widen(ranges, size_.x);
  }

  /// Of sample `index`, the cells along an axis, relative to the tile's first, that have it near: first <= cell < end.
  static std::int64_t first_near(std::int64_t index) { return std::max<std::int64_t>(index - kNear - 1, 0); }
  static std::int64_t end_near(std::int64_t index, std::int64_t size) { return std::min(index + kNear + 1, size); }

  /// work.near. Beyond the extents the border repeats: clip to them.
  void range_coefficients(TileWork& work) const {
    const glm::i64vec3 from = glm::max(low_ - kNear, glm::i64vec3(0));
    const glm::i64vec3 to = glm::min(high_ + kNear + std::int64_t(1), c_.extents);
    Ranges row;
    for (std::int64_t k = from.z; k < to.z; ++k) {
      for (Ranges& r : work.near_in_plane) r.clear();
      for (std::int64_t j = from.y; j < to.y; ++j) {
        range_near(j, k, row);
        for (std::int64_t y = first_near(j - low_.y); y < end_near(j - low_.y, size_.y); ++y)
          work.near_in_plane[std::size_t(y)].widen(row, size_.x);
      }
      for (std::int64_t z = first_near(k - low_.z); z < end_near(k - low_.z, size_.z); ++z)
        for (std::int64_t y = 0; y < size_.y; ++y) at(work.near, y, z).widen(work.near_in_plane[std::size_t(y)], size_.x);
    }
  }

  /// The ranges of the row (j,k) of coefficients near each cell along x: 2 kNear + 2 of them, found in pairs.
  void range_near(std::int64_t j, std::int64_t k, Ranges& ranges) const {
    Line line;
    const std::int64_t count = size_.x + 2 * kNear + 1, first = low_.x - kNear;
    const float* row = c_.data.data() + c_.number(0, {0, j, k});
    for (std::int64_t i = 0; i < count; ++i) line[i] = row[std::clamp<std::int64_t>(first + i, 0, c_.extents.x - 1)];
    const auto window = [&](Line& out, const auto& pick) {
      Line pair;
      for (std::int64_t i = 0; i + 1 < count; ++i) pair[i] = pick(line[i], line[i + 1]);
      for (std::int64_t i = 0; i < size_.x; ++i) out[i] = pick(pair[i], pair[i + 2]);
      if (kNear == 2)
        for (std::int64_t i = 0; i < size_.x; ++i) out[i] = pick(out[i], pair[i + 4]);
    };
    window(ranges.low, [](float a, float b) { return a < b ? a : b; });
    window(ranges.high, [](float a, float b) { return a > b ? a : b; });
  }

  /// Where a cell's neighbours need coefficients from beyond the extents, they may have any that the scale allows.
  void widen_at_the_ends(const BoundsScale& scale, TileWork& work) const {
    const auto at_end = [&](std::int64_t cell, std::int64_t extent) {
      return cell - kNear < 0 || cell + 1 + kNear >= extent;
    };
    Ranges all;
    all.low.fill(std::nextafter(float(scale.least), std::numeric_limits<float>::lowest()));
    all.high.fill(std::nextafter(float(scale.most), std::numeric_limits<float>::max()));
    for (std::int64_t z = 0; z < size_.z; ++z)
      for (std::int64_t y = 0; y < size_.y; ++y) {
        Ranges& row = at(work.near, y, z);
        if (at_end(low_.y + y, c_.extents.y) || at_end(low_.z + z, c_.extents.z)) row.widen(all, size_.x);
        for (std::int64_t x = 0; x < size_.x; ++x)
          if (at_end(low_.x + x, c_.extents.x)) row.low[x] = all.low[x], row.high[x] = all.high[x];
      }
  }

  void finish(TileWork& work, std::int64_t y, std::int64_t z, const Margin& margin, CellBounds& bounds) const {
    const Ranges &net = at(work.net, y, z), &near = at(work.near, y, z);
    const auto around = [&](std::int64_t i) {
      const double least = near.low[i], most = near.high[i], m = std::max(most, -least);
      return margin.per_width * (double(net.high[i]) - double(net.low[i])) + margin.per_near_width * (most - least) +
             margin.per_magnitude * m + kBoundsTiny;
    };
    const std::size_t first = bounds.number(low_ + glm::i64vec3(0, y, z));
    quantise<1>(bounds, net.low.data(), net.high.data(), around, size_.x, bounds.min.data() + first, bounds.max.data() + first);
  }

  const Coefficients<float>& c_;
  glm::i64vec3 low_, high_, size_;
};

template <class Net>
void tensor_bounds(const Coefficients<float>& c, const Margin& margin, const BoundsScale& scale, Surroundings surroundings,
                   const Progress& progress, CellBounds& bounds) {
  assert(c.lattice == LatticeKind::cartesian && c.apron >= Net::kBefore);
  const glm::i64vec3 size(kLong, kTile, kTile), tiles = (bounds.cells + size - std::int64_t(1)) / size;
  tbb::enumerable_thread_specific<TileWork> works;
  for_each_tile(tiles.x * tiles.y * tiles.z, progress, [&](std::int64_t t) {
    const glm::i64vec3 low = size * glm::i64vec3(t % tiles.x, t / tiles.x % tiles.y, t / (tiles.x * tiles.y));
    Tile<Net>(c, low, glm::min(low + size, bounds.cells)).compute(margin, scale, surroundings, works.local(), bounds);
  });
}

}  // namespace

Margin trilinear_margin(double d) { return {0.0, d * (1.0 + 2.0 * d) * (1.0 + 2.0 * d), 256.0 * kBoundsEpsilon}; }

Margin triquadratic_margin(double d) { return {4.0 * d, 4.0 * d * d, 256.0 * kBoundsEpsilon}; }

Margin tricubic_margin(double d) { return {3.0 * d, 16.0 * d * d, 512.0 * kBoundsEpsilon}; }

Margin catmull_rom_margin(double d) { return {3.0 * d, 24.0 * d * d, 512.0 * kBoundsEpsilon}; }

void trilinear_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                      const Progress& progress, CellBounds& bounds) {
  tensor_bounds<Linear>(c, trilinear_margin(scale.displacement), scale, surroundings, progress, bounds);
}

void triquadratic_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                         const Progress& progress, CellBounds& bounds) {
  tensor_bounds<Quadratic>(c, triquadratic_margin(scale.displacement), scale, surroundings, progress, bounds);
}

void tricubic_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                     const Progress& progress, CellBounds& bounds) {
  tensor_bounds<Cubic>(c, tricubic_margin(scale.displacement), scale, surroundings, progress, bounds);
}

void catmull_rom_bounds(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                        const Progress& progress, CellBounds& bounds) {
  tensor_bounds<CatmullRom>(c, catmull_rom_margin(scale.displacement), scale, surroundings, progress, bounds);
}

}  // namespace quincunx

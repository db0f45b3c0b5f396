// Bounds of splines over cells: the list of them, and their scale.
//
// On a polynomial piece the spline lies between the least and the largest of its Bernstein coefficients (its net; cwlb, which has none, has
// values of which it is a mean). The
// range of a cell's net is widened by what 32-bit floats may add: the margin, which each spline's file derives for its
// kernel. Let e = 2^-24, and d the largest 1-norm, in cells, of the distance between a point that a kernel means and
// the one it computes. A kernel computes o + t d per axis from numbers rounded once, relative to the volume's middle:
// with n cells along the axis o and the sum err by n e / 2 each, d t and the product by n e each, t (which moves along
// the ray) by 3 n e through the exit it comes from: 6 n e an axis. So d = 6 e (nx + ny + nz), and at least 2^-13,
// which is an error of 4e-5 in each axis.
//
// Numbers of coefficients are supposed to be below 1e36 in absolute value: above, floats overflow in any kernel (float_unit sees to it).
#include "accel/bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "accel/bcc12_bounds.h"
#include "accel/cwlb_bounds.h"
#include "accel/kuhn_bounds.h"
#include "accel/tensor_bounds.h"

namespace quincunx {
namespace {

struct Row {
  std::string_view spline;
  double net_gain;  ///< how far from the middle of the coefficients' range the net may be, in halves of it: 1 for a generator nowhere negative
  Margin (*margin)(double displacement);
  void (*compute)(const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                  const Progress& progress, CellBounds& bounds);
};

/// The one list of splines that have bounds.
constexpr Row kRows[] = {
    {"bcc4", 1.0, bcc4_margin, bcc4_bounds},
    {"bcc7", 1.0, bcc7_margin, bcc7_bounds},
    {"bcc8", 1.0, bcc8_margin, bcc8_bounds},
    {"bcc12", 1.0, bcc12_margin, bcc12_bounds},
    {"cwlb", 1.0, cwlb_margin, cwlb_bounds},
    {"trilinear", 1.0, trilinear_margin, trilinear_bounds},
    {"triquadratic", 1.0, triquadratic_margin, triquadratic_bounds},
    {"tricubic", 1.0, tricubic_margin, tricubic_bounds},
    {"catmull-rom", 64.0 / 27.0, catmull_rom_margin, catmull_rom_bounds},
};

const Row& row_of(const Spline& spline) {
  for (const Row& row : kRows)
    if (row.spline == spline.name()) return row;
  throw std::logic_error("spline " + std::string(spline.name()) + " has no bounds");
}

double displacement(const glm::i64vec3& cells) { return std::max(0x1p-13, ray_displacement(cells)); }

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

/// The scale on which value(0) and value(65535) enclose every widened interval of coefficients from `least` to `most`: the net's values
/// and widths are within net_gain of them, computed within 32 e m, and the margin grows with widths and magnitude.
BoundsScale scale_of(const Row& row, double least, double most, const glm::i64vec3& cells) {
  BoundsScale scale;
  scale.least = least, scale.most = most, scale.displacement = displacement(cells);
  const Margin margin = row.margin(scale.displacement);
  const double m = std::max(std::abs(least), std::abs(most)), rounding = 64.0 * kBoundsEpsilon * m;
  const double beyond = 0.5 * (row.net_gain - 1.0) * (most - least);
  const double around = beyond + (row.net_gain * margin.per_width + margin.per_near_width) * (most - least + rounding) + margin.per_magnitude * m +
                        rounding + 2.0 * kBoundsTiny;
  scale.low = least - around;
  scale.step = (most + around - scale.low) / 65535.0;
  while (scale.value(65535) < most + around)
    scale.step = std::nextafter(scale.step, std::numeric_limits<double>::max());
  return scale;
}

CellBounds bounds_on(const Row& row, const Coefficients<float>& c, const BoundsScale& scale, Surroundings surroundings,
                     const Progress& progress) {
  CellBounds bounds;
  static_cast<ValueScale&>(bounds) = scale;
  bounds.cells = cell_count(c.lattice, c.extents);
  bounds.min.resize(std::size_t(bounds.cells.x * bounds.cells.y * bounds.cells.z));
  bounds.max.resize(bounds.min.size());
  row.compute(c, scale, surroundings, progress, bounds);
  return bounds;
}

}  // namespace

double kernel_rounding(const Spline& spline) { return row_of(spline).margin(0.0).per_magnitude / kBoundsEpsilon; }

double ray_displacement(const glm::i64vec3& cells) { return 6.0 * kBoundsEpsilon * double(cells.x + cells.y + cells.z); }

CellBounds cell_bounds(const Spline& spline, const Coefficients<float>& c, const Progress& progress) {
  assert(c.lattice == spline.lattice() && c.apron >= spline.apron());
  const Row& row = row_of(spline);
  const Range range = coefficient_range(c.data);
  const BoundsScale scale = scale_of(row, range.low, range.high, cell_count(c.lattice, c.extents));
  return bounds_on(row, c, scale, Surroundings::border, progress);
}

BoundsScale bounds_scale(const Spline& spline, Spline::Prefilter prefilter, double sample_min, double sample_max, const glm::i64vec3& cells) {
  assert(sample_min <= sample_max);
  const Row& row = row_of(spline);
  // The weights sum to 1. Coefficients are rounded to floats, below 2 e m of what the samples' largest can make.
  const double middle = 0.5 * (sample_min + sample_max), half = 0.5 * (sample_max - sample_min) * spline.filter(prefilter).gain;
  const double rounding = 2.0 * kBoundsEpsilon * (std::abs(middle) + half);
  return scale_of(row, middle - half - rounding, middle + half + rounding, cells);
}

double value_error(const Spline& spline, const BoundsScale& scale, double error) {
  // The net moves by at most net_gain errors, and widths by twice that.
  const Row& row = row_of(spline);
  const Margin margin = row.margin(scale.displacement);
  return (row.net_gain * (1.0 + 2.0 * margin.per_width) + 2.0 * margin.per_near_width + margin.per_magnitude) * error;
}

CellBounds cell_bounds(const Spline& spline, const Coefficients<float>& c, const BoundsScale& scale) {
  assert(c.lattice == spline.lattice() && c.apron >= spline.apron());
  return bounds_on(row_of(spline), c, scale, Surroundings::unknown, {});
}

}  // namespace quincunx

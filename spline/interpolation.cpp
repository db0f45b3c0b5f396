#include "spline/interpolation.h"

#include <tbb/enumerable_thread_specific.h>

#include <cmath>
#include <limits>

#include "spline/convolution.h"

namespace quincunx {
namespace {

constexpr double kSlabs = 0.8;  // of the progress

/// The mask across rows of numbers.
class RowFilter {
 public:
  explicit RowFilter(const InterpolationMask& mask) : reach_(mask.reach) {
    const double centre = (1.0 - mask.pole) / (1.0 + mask.pole);
    for (int a = 1; a <= reach_; ++a) side_.push_back(centre * std::pow(mask.pole, a));
  }
  int reach() const { return reach_; }

  /// out[i], i < n, from the numbers i of 2 reach + 1 rows. The weights sum to 1, so what the centre weighs follows from the others: sums of
  /// differences from it, smallest weights first.
  void apply(const double* const* rows, std::int64_t n, double* out) const {
    constexpr std::int64_t kBlock = 128;
    double twice[kBlock], sum[kBlock];
    for (std::int64_t first = 0; first < n; first += kBlock) {
      const std::int64_t count = std::min(kBlock, n - first);
      const double* centre = rows[reach_] + first;
      for (std::int64_t i = 0; i < count; ++i) twice[i] = 2.0 * centre[i], sum[i] = 0.0;
      for (int a = reach_; a >= 1; --a) {
        const double *before = rows[reach_ - a] + first, *after = rows[reach_ + a] + first, w = side_[std::size_t(a - 1)];
        for (std::int64_t i = 0; i < count; ++i) sum[i] += w * ((before[i] + after[i]) - twice[i]);
      }
      for (std::int64_t i = 0; i < count; ++i) out[first + i] = centre[i] + sum[i];
    }
  }

 private:
  int reach_;
  std::vector<double> side_;  ///< weights at 1, 2 ...
};

/// What one thread works with: a slab of rows, one of them extended, and places of rows.
struct Work {
  std::vector<double> slab, extended;
  std::vector<const double*> rows;
};

/// Filters `slab`, `count` rows of n numbers, across its rows, which are extended by clamping. Row i of the result goes to out + i stride.
void filter_across(const RowFilter& filter, std::int64_t n, std::int64_t count, Work& work, double* out, std::int64_t stride) {
  const int reach = filter.reach();
  work.rows.resize(std::size_t(2 * reach + 1));
  for (std::int64_t i = 0; i < count; ++i) {
    for (int a = -reach; a <= reach; ++a)
      work.rows[std::size_t(a + reach)] = work.slab.data() + std::clamp<std::int64_t>(i + a, 0, count - 1) * n;
    filter.apply(work.rows.data(), n, out + i * stride);
  }
}

/// Plane k of the samples, filtered along x and y.
template <class S>
void filter_plane(const RowFilter& filter, const SampleRows<S>& source, std::int64_t k, Work& work, double* out) {
  const std::int64_t nx = source.extents.x, ny = source.extents.y;
  const int reach = filter.reach();
  work.slab.resize(std::size_t(nx * ny));
  work.extended.resize(std::size_t(nx + 2 * reach));
  work.rows.resize(std::size_t(2 * reach + 1));
  for (int a = 0; a <= 2 * reach; ++a) work.rows[std::size_t(a)] = work.extended.data() + a;
  for (std::int64_t j = 0; j < ny; ++j) {
    std::copy_n(source.row(0, j, k), nx, work.extended.data() + reach);
    extend_row(work.extended.data() + reach, nx, reach);
    filter.apply(work.rows.data(), nx, work.slab.data() + j * nx);
  }
  filter_across(filter, nx, ny, work, out, nx);
}

/// The samples filtered along all axes, x fastest.
std::vector<double> filtered(const Volume& volume, const InterpolationMask& mask, const Progress& progress) {
  const RowFilter filter(mask);
  const Extents& n = volume.extents;
  std::vector<double> data(std::size_t(n.x * n.y * n.z));
  tbb::enumerable_thread_specific<Work> works;
  SharedProgress shared(progress, n.y + n.z);
  std::visit(
      [&](const auto& samples) {
        const SampleRows<typename std::decay_t<decltype(samples)>::value_type> source{samples.data(), n};
        tbb::parallel_for(std::int64_t(0), n.z, [&](std::int64_t k) {
          filter_plane(filter, source, k, works.local(), data.data() + k * n.x * n.y);
          shared.add(1);
        });
      },
      volume.samples);
  tbb::parallel_for(std::int64_t(0), n.y, [&](std::int64_t j) {
    Work& work = works.local();
    work.slab.resize(std::size_t(n.x * n.z));
    for (std::int64_t k = 0; k < n.z; ++k) std::copy_n(data.data() + (k * n.y + j) * n.x, n.x, work.slab.data() + k * n.x);
    filter_across(filter, n.x, n.z, work, data.data() + j * n.x, n.x * n.y);
    shared.add(1);
  });
  return data;
}

}  // namespace

template <class T>
Coefficients<T> interpolating_coefficients(const Volume& volume, const InterpolationMask& mask, int apron, std::string_view spline,
                                           const ValueUnit& unit, const Progress& progress) {
  check_samples(volume, LatticeKind::cartesian, spline);
  const std::vector<double> data = filtered(volume, mask, [&](double fraction) { report(progress, kSlabs * fraction); });
  const Extents n = volume.extents;
  const auto row = [&](const auto&, int, std::int64_t j, std::int64_t k, T* out, double*) {
    const double *from = data.data() + (k * n.y + j) * n.x, inverse = 1.0 / unit.scale;
    double largest = 0.0;
    for (std::int64_t i = 0; i < n.x; ++i) {
      const double value = (from[i] - unit.offset) * inverse;
      largest = std::max(largest, std::abs(value));
      out[i] = T(value);
    }
    return largest <= double(std::numeric_limits<T>::max());
  };
  return convolve<T>(volume, LatticeKind::cartesian, cartesian_apron(volume.extents, apron), spline, unit, row,
                     [&](double fraction) { report(progress, kSlabs + (1.0 - kSlabs) * fraction); });
}

template Coefficients<double> interpolating_coefficients(const Volume&, const InterpolationMask&, int, std::string_view, const ValueUnit&,
                                                         const Progress&);
template Coefficients<float> interpolating_coefficients(const Volume&, const InterpolationMask&, int, std::string_view, const ValueUnit&,
                                                        const Progress&);

}  // namespace quincunx

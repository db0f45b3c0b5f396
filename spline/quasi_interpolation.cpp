#include "spline/quasi_interpolation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <string>

#include "lattice/error.h"

namespace quincunx {
namespace {

/// Clamped rows of samples: the only way in which the convolution reads a volume.
template <class S>
struct SampleRows {
  const S* samples;
  Extents extents;

  const S* row(int coset, std::int64_t j, std::int64_t k) const {
    j = std::clamp<std::int64_t>(j, 0, extents.y - 1);
    k = std::clamp<std::int64_t>(k, 0, extents.z - 1);
    return samples + ((coset * extents.z + k) * extents.y + j) * extents.x;
  }
};

/// Repeats the ends of a row of n values `width` times on both sides.
template <class T>
void extend_row(T* row, std::int64_t n, int width) {
  std::fill_n(row - width, width, row[0]);
  std::fill_n(row + n, width, row[n - 1]);
}

/// Convolves row (j,k) of a coset. `out` receives extents.x values; `own` and `diagonal` are scratch of extents.x + 2.
/// Returns whether every value fits T.
template <class T, class S>
bool convolve_row(const SampleRows<S>& source, const BccMask& mask, int coset, std::int64_t j, std::int64_t k, T* out,
                  double* own, double* diagonal) {
  const std::int64_t n = source.extents.x;
  const S* centre = source.row(coset, j, k);
  const S *below = source.row(coset, j - 1, k), *above = source.row(coset, j + 1, k);
  const S *behind = source.row(coset, j, k - 1), *before = source.row(coset, j, k + 1);
  // The diagonal neighbours of index i are i + coset - 1 and i + coset of the other coset, along every axis.
  const std::int64_t j0 = j + coset - 1, k0 = k + coset - 1;
  const S *d00 = source.row(1 - coset, j0, k0), *d10 = source.row(1 - coset, j0 + 1, k0);
  const S *d01 = source.row(1 - coset, j0, k0 + 1), *d11 = source.row(1 - coset, j0 + 1, k0 + 1);
  for (std::int64_t i = 0; i < n; ++i) {
    own[1 + i] = centre[i];
    diagonal[1 + i] = (double(d00[i]) + double(d10[i])) + (double(d01[i]) + double(d11[i]));
  }
  extend_row(own + 1, n, 1);
  extend_row(diagonal + 1, n, 1);

  double largest = 0.0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double cross = (double(below[i]) + double(above[i])) + (double(behind[i]) + double(before[i]));
    const double axial = cross + (own[i] + own[i + 2]);
    const double diagonals = diagonal[i + coset] + diagonal[i + coset + 1];
    const double value = (mask.centre * own[i + 1] + mask.axial * axial + mask.diagonal * diagonals) / mask.denominator;
    largest = std::max(largest, value < 0.0 ? -value : value);
    out[i] = T(value);
  }
  return largest <= double(std::numeric_limits<T>::max());
}

/// Reports how many of `total` parts are done, from any thread; a thread that finds another one reporting goes on.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::int64_t total) : progress_(progress), total_(total) {}
  void add(std::int64_t parts) {
    const std::int64_t done = done_ += parts;
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock) report(progress_, double(done) / double(total_));
  }

 private:
  const Progress& progress_;
  const std::int64_t total_;
  std::atomic<std::int64_t> done_{0};
  std::mutex mutex_;
};

/// Convolves one z plane of a coset into `out` and extends it along x and y. Returns whether every value fits T.
template <class T, class S>
bool convolve_plane(const SampleRows<S>& source, const BccMask& mask, int coset, std::int64_t k, Coefficients<T>& out) {
  std::vector<double> own(std::size_t(out.extents.x + 2)), diagonal(std::size_t(out.extents.x + 2));
  bool fits = true;
  for (std::int64_t j = 0; j < out.extents.y; ++j) {
    T* row = out.data.data() + out.number(coset, {0, j, k});
    fits = convolve_row(source, mask, coset, j, k, row, own.data(), diagonal.data()) && fits;
    extend_row(row, out.extents.x, out.apron);
  }
  const auto copy_row = [&](std::int64_t from, std::int64_t to) {
    std::copy_n(out.data.data() + out.number(coset, {-out.apron, from, k}), out.stride_y(),
                out.data.data() + out.number(coset, {-out.apron, to, k}));
  };
  for (int a = 1; a <= out.apron; ++a) {
    copy_row(0, -a);
    copy_row(out.extents.y - 1, out.extents.y - 1 + a);
  }
  return fits;
}

/// Extends every coset along z by copies of its first and last plane.
template <class T>
void extend_planes(Coefficients<T>& out) {
  for (int coset = 0; coset < coset_count(out.lattice); ++coset)
    for (int a = 1; a <= out.apron; ++a)
      for (const auto& [from, to] : {std::pair<std::int64_t, std::int64_t>{0, -a},
                                     std::pair<std::int64_t, std::int64_t>{out.extents.z - 1, out.extents.z - 1 + a}})
        std::copy_n(out.data.data() + out.number(coset, {-out.apron, -out.apron, from}), out.stride_z(),
                    out.data.data() + out.number(coset, {-out.apron, -out.apron, to}));
}

template <class T, class S>
bool convolve(const SampleRows<S>& source, const BccMask& mask, Coefficients<T>& out, const Progress& progress) {
  const std::int64_t planes = coset_count(out.lattice) * out.extents.z;
  SharedProgress shared(progress, planes);
  std::atomic<bool> fits = true;
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, planes), [&](const tbb::blocked_range<std::int64_t>& range) {
    for (std::int64_t p = range.begin(); p < range.end(); ++p) {
      if (!convolve_plane(source, mask, int(p / out.extents.z), p % out.extents.z, out)) fits = false;
      shared.add(1);
    }
  });
  extend_planes(out);
  report(progress, 1.0);
  return fits;
}

/// Throws InputError unless a spline on the BCC lattice can be made of the volume.
void check_samples(const Volume& volume, std::string_view spline) {
  const std::string who = "spline " + std::string(spline) + ": ";
  if (volume.lattice != LatticeKind::bcc)
    throw InputError(who + "found a volume on the " + std::string(lattice_name(volume.lattice)) +
                     " lattice, expected bcc");
  check_volume(volume, "spline " + std::string(spline));
  const SampleRange range = sample_range(volume);
  if (range.not_finite == 0) return;
  const auto n = std::int64_t(range.first_not_finite);
  const Extents& e = volume.extents;
  throw InputError(who + "found " + std::to_string(range.not_finite) + " NaN or infinite of " +
                   std::to_string(volume.sample_count()) + " samples, the first at coset " +
                   std::to_string(n / (e.x * e.y * e.z)) + ", index (" + std::to_string(n % e.x) + ", " +
                   std::to_string(n / e.x % e.y) + ", " + std::to_string(n / (e.x * e.y) % e.z) +
                   "); expected finite samples");
}

}  // namespace

template <class T>
Coefficients<T> bcc_coefficients(const Volume& volume, const BccMask& mask, int apron, std::string_view spline,
                                 const Progress& progress) {
  check_samples(volume, spline);
  Coefficients<T> out;
  out.lattice = volume.lattice;
  out.extents = volume.extents;
  out.apron = apron;
  out.world = volume.world;
  out.data.resize(std::size_t(coset_count(out.lattice) * out.stride_coset()));
  const bool fits = std::visit(
      [&](const auto& samples) {
        using S = typename std::decay_t<decltype(samples)>::value_type;
        return convolve(SampleRows<S>{samples.data(), volume.extents}, mask, out, progress);
      },
      volume.samples);
  if (!fits)
    throw InputError("spline " + std::string(spline) + ": found samples so large that coefficients overflow " +
                     (sizeof(T) == 4 ? "float" : "double") + "; expected smaller ones");
  return out;
}

template Coefficients<double> bcc_coefficients(const Volume&, const BccMask&, int, std::string_view, const Progress&);
template Coefficients<float> bcc_coefficients(const Volume&, const BccMask&, int, std::string_view, const Progress&);

}  // namespace quincunx

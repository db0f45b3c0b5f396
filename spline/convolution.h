// Rows of samples, convolved in parallel into padded coefficients: what the prefilters of all lattices share.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <string_view>
#include <utility>
#include <vector>

#include "lattice/shared_progress.h"
#include "lattice/volume.h"
#include "spline/coefficients.h"

namespace quincunx {

/// Throws InputError unless a spline on `lattice` can be made of the volume: its samples are as many as its extents say
/// and finite. `spline` is the spline's name.
void check_samples(const Volume& volume, LatticeKind lattice, std::string_view spline);

/// Throws InputError: the samples are so large that their coefficients overflow `type`.
[[noreturn]] void refuse_overflow(std::string_view spline, std::string_view type);

/// Clamped rows of samples: the only way in which a convolution reads a volume.
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

/// The apron of coefficients on the Cartesian lattice for a spline's: the one cell of an axis of one sample reaches as far beyond it as a cell
/// beyond the last one would.
inline int cartesian_apron(const Extents& n, int apron) { return n.x == 1 || n.y == 1 || n.z == 1 ? apron + 1 : apron; }

/// Repeats the ends of a row of n values `width` times on both sides.
template <class T>
void extend_row(T* row, std::int64_t n, int width) {
  std::fill_n(row - width, width, row[0]);
  std::fill_n(row + n, width, row[n - 1]);
}

/// Computes one z plane of a coset of `out` row by row and extends it along x and y. Returns whether every value fits T.
template <class T, class S, class Row>
bool convolve_plane(const SampleRows<S>& source, const Row& row, int coset, std::int64_t k, Coefficients<T>& out) {
  std::vector<double> scratch(std::size_t(2 * (out.extents.x + 2)));
  bool fits = true;
  for (std::int64_t j = 0; j < out.extents.y; ++j) {
    T* to = out.data.data() + out.number(coset, {0, j, k});
    fits = row(source, coset, j, k, to, scratch.data()) && fits;
    extend_row(to, out.extents.x, out.apron);
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

/// The coefficients that `row` makes of the volume's samples, extended by `apron` on every side. `row` is called as
///   bool row(const SampleRows<S>& source, int coset, int64 j, int64 k, T* out, double* scratch)
/// from several threads, for every type S of samples; it writes the extents.x coefficients of the row (j,k), in `unit`, to `out`, has
/// 2 * (extents.x + 2) numbers of scratch, and returns whether every value fits T.
/// Throws InputError as check_samples and refuse_overflow do.
template <class T, class Row>
Coefficients<T> convolve(const Volume& volume, LatticeKind lattice, int apron, std::string_view spline, const ValueUnit& unit,
                         const Row& row, const Progress& progress) {
  check_samples(volume, lattice, spline);
  Coefficients<T> out;
  out.lattice = lattice;
  out.extents = volume.extents;
  out.apron = apron;
  out.world = volume.world;
  out.unit = unit;
  out.data.resize(std::size_t(coset_count(lattice) * out.stride_coset()));

  const std::int64_t planes = coset_count(lattice) * out.extents.z;
  SharedProgress shared(progress, planes);
  std::atomic<bool> fits = true;
  std::visit(
      [&](const auto& samples) {
        const SampleRows<typename std::decay_t<decltype(samples)>::value_type> source{samples.data(), volume.extents};
        using Planes = tbb::blocked_range<std::int64_t>;
        tbb::parallel_for(Planes(0, planes), [&](const Planes& range) {
          for (std::int64_t p = range.begin(); p < range.end(); ++p) {
            if (!convolve_plane(source, row, int(p / out.extents.z), p % out.extents.z, out)) fits = false;
            shared.add(1);
          }
        });
      },
      volume.samples);
  if (!fits) refuse_overflow(spline, sizeof(T) == 4 ? "float" : "double");
  extend_planes(out);
  report(progress, 1.0);
  return out;
}

}  // namespace quincunx

#include "lattice/low_pass.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "lattice/shared_progress.h"

namespace quincunx {
namespace {

constexpr double kZeros = 6.0;  // of the sinc, on either side
constexpr double kBeta = 6.0;

/// Weights of the samples `first`, first + 1 ... index steps away.
struct Taps {
  std::int64_t first = 0;
  std::vector<double> weights{1.0};

  double sum() const {
    double s = 0.0;
    for (const double w : weights) s += w;
    return s;
  }
  void scale(double by) {
    for (double& w : weights) w *= by;
  }
};

double windowed_sinc(double x, double cutoff) {
  const double reach = 0.5 * kZeros / cutoff, part = x / reach;
  if (std::abs(part) >= 1.0) return 0.0;
  const double phase = 2.0 * glm::pi<double>() * cutoff * x;
  const double sinc = phase == 0.0 ? 1.0 : std::sin(phase) / phase;
  return sinc * std::cyl_bessel_i(0.0, kBeta * std::sqrt(1.0 - part * part)) / std::cyl_bessel_i(0.0, kBeta);
}

/// Of samples `step` lattice coordinates apart, the nearest one `shift` away.
Taps taps(double cutoff, int step, int shift) {
  if (std::isinf(cutoff)) return {};
  const std::int64_t reach = std::int64_t(std::ceil(0.5 * kZeros / cutoff / step)) + 1;
  Taps t{-reach, {}};
  for (std::int64_t m = -reach; m <= reach; ++m) t.weights.push_back(windowed_sinc(double(step * m + shift), cutoff));
  return t;
}

/// A coset's samples.
using Grid = std::vector<double>;

/// Adds rows: to[i] += w from[i].
void add_row(double w, const double* from, double* to, std::int64_t n) {
  for (std::int64_t i = 0; i < n; ++i) to[i] += w * from[i];
}

/// The convolution along one axis.
Grid convolved(const Grid& from, const Extents& n, int axis, const Taps& t, SharedProgress& progress) {
  if (t.weights.size() == 1 && t.weights[0] == 1.0) return progress.add(n.z), from;
  Grid to(from.size());
  const glm::i64vec3 stride(1, n.x, n.x * n.y);
  const std::int64_t last = n[axis] - 1;
  tbb::parallel_for(std::int64_t(0), n.z, [&](std::int64_t k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      const std::int64_t row = j * stride.y + k * stride.z, at = axis == 1 ? j : k;
      double* out = to.data() + row;
      for (std::int64_t m = 0; m < std::int64_t(t.weights.size()); ++m) {
        const double w = t.weights[std::size_t(m)];
        if (axis > 0) {
          const std::int64_t other = std::clamp<std::int64_t>(at + t.first + m, 0, last);
          add_row(w, from.data() + row + (other - at) * stride[axis], out, n.x);
          continue;
        }
        // From `begin` to `end` the sample is inside, elsewhere the first or the last one.
        const std::int64_t by = t.first + m, begin = std::clamp<std::int64_t>(-by, 0, n.x), end = std::clamp<std::int64_t>(n.x - by, begin, n.x);
        for (std::int64_t i = 0; i < begin; ++i) out[i] += w * from[std::size_t(row)];
        add_row(w, from.data() + row + begin + by, out + begin, end - begin);
        for (std::int64_t i = end; i < n.x; ++i) out[i] += w * from[std::size_t(row + last)];
      }
    }
    progress.add(1);
  });
  return to;
}

Grid convolved(Grid grid, const Extents& n, const std::array<Taps, 3>& t, SharedProgress& progress) {
  for (int axis = 0; axis < 3; ++axis) grid = convolved(grid, n, axis, t[std::size_t(axis)], progress);
  return grid;
}

double product_of_sums(const std::array<Taps, 3>& t) { return t[0].sum() * t[1].sum() * t[2].sum(); }

}  // namespace

double band_limit(LatticeKind lattice) { return lattice == LatticeKind::bcc ? std::exp2(-5.0 / 3.0) : 0.5; }

Volume low_pass(const Volume& volume, const glm::dvec3& cutoff, const Progress& progress) {
  check_volume(volume, "volume");
  check_finite(sample_range(volume), volume, "volume");
  const int cosets = coset_count(volume.lattice), step = lattice_step(volume.lattice);
  const Extents& n = volume.extents;
  std::vector<Grid> grids(static_cast<std::size_t>(cosets));
  std::visit(
      [&](const auto& samples) {
        const std::ptrdiff_t each = std::ptrdiff_t(samples.size() / std::size_t(cosets));
        for (int c = 0; c < cosets; ++c) grids[std::size_t(c)] = Grid(samples.begin() + c * each, samples.begin() + (c + 1) * each);
      },
      volume.samples);

  // Weights of a coset's own samples, and, seen from the even one (+1) and from the odd one (-1), of the other's.
  const auto all_axes = [&](int shift) { return std::array{taps(cutoff.x, step, shift), taps(cutoff.y, step, shift), taps(cutoff.z, step, shift)}; };
  std::array<Taps, 3> own = all_axes(0), after = all_axes(1), before = all_axes(-1);
  assert(cosets == 1 || !glm::any(glm::isinf(cutoff)));
  const double scale = 1.0 / (product_of_sums(own) + (cosets == 2 ? product_of_sums(after) : 0.0));
  for (auto* t : {&own, &after, &before}) (*t)[0].scale(scale);

  SharedProgress shared(progress, 3 * n.z * cosets * cosets);
  std::vector<float> out;
  out.reserve(volume.sample_count());
  for (int c = 0; c < cosets; ++c) {
    Grid sum = convolved(grids[std::size_t(c)], n, own, shared);
    if (cosets == 2) {
      const Grid other = convolved(grids[std::size_t(1 - c)], n, c == 0 ? after : before, shared);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other[i];
    }
    for (const double x : sum) out.push_back(float(x));
  }
  Volume filtered{volume.lattice, volume.extents, volume.world, std::move(out), volume.notes};
  report(progress, 1.0);
  return filtered;
}

}  // namespace quincunx

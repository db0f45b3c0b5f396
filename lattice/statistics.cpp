// The range and the quantiles of a volume's samples.
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>

#include "lattice/volume.h"

namespace quincunx {
namespace {

/// Range of part of the samples. `low > high` where none is finite.
template <class T>
struct PartialRange {
  T low = std::numeric_limits<T>::max(), high = std::numeric_limits<T>::lowest();
  std::size_t not_finite = 0, first_not_finite = std::numeric_limits<std::size_t>::max();

  void add(T value, std::size_t number) {
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) {
        ++not_finite;
        first_not_finite = std::min(first_not_finite, number);
        return;
      }
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  static PartialRange join(const PartialRange& a, const PartialRange& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high), a.not_finite + b.not_finite,
            std::min(a.first_not_finite, b.first_not_finite)};
  }
};

template <class T>
SampleRange range_of(const std::vector<T>& samples) {
  using Blocks = tbb::blocked_range<std::size_t>;
  const auto total = tbb::parallel_reduce(
      Blocks(0, samples.size(), 1 << 16), PartialRange<T>{},
      [&](const Blocks& block, PartialRange<T> part) {
        for (std::size_t n = block.begin(); n != block.end(); ++n) part.add(samples[n], n);
        return part;
      },
      PartialRange<T>::join);
  SampleRange range;
  if (total.low <= total.high) range.min = double(total.low), range.max = double(total.high);
  range.not_finite = total.not_finite;
  range.first_not_finite = total.not_finite == 0 ? 0 : total.first_not_finite;
  return range;
}

/// The rank of the quantile at `fraction` among n samples, n >= 1.
std::size_t quantile_rank(double fraction, std::size_t n) {
  assert(fraction >= 0.0 && fraction <= 1.0);
  return std::min(n - 1, std::size_t(std::floor(fraction * double(n - 1) + 0.5)));
}

/// By counting: integers of 8 or 16 bits.
template <class T>
requires std::is_integral_v<T> std::vector<double> quantiles_of(const std::vector<T>& samples,
                                                                std::span<const double> fractions) {
  constexpr int lowest = std::numeric_limits<T>::lowest();
  std::vector<std::size_t> histogram(std::size_t(std::numeric_limits<T>::max() - lowest) + 1, 0);
  for (const T s : samples) ++histogram[std::size_t(int(s) - lowest)];

  std::vector<double> quantiles;
  for (const double fraction : fractions) {
    const std::size_t rank = quantile_rank(fraction, samples.size());
    std::size_t bin = 0;
    for (std::size_t below = histogram[0]; below <= rank; below += histogram[++bin]) {
    }
    quantiles.push_back(double(int(bin) + lowest));
  }
  return quantiles;
}

std::vector<double> quantiles_of(const std::vector<float>& samples, std::span<const double> fractions) {
  std::vector<float> finite;
  finite.reserve(samples.size());
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(finite), [](float s) { return std::isfinite(s); });
  if (finite.empty()) return std::vector<double>(fractions.size(), 0.0);

  std::vector<double> quantiles;
  for (const double fraction : fractions) {
    const auto nth = finite.begin() + std::ptrdiff_t(quantile_rank(fraction, finite.size()));
    std::nth_element(finite.begin(), nth, finite.end());
    quantiles.push_back(double(*nth));
  }
  return quantiles;
}

}  // namespace

SampleRange sample_range(const Volume& volume) {
  return std::visit([](const auto& s) { return range_of(s); }, volume.samples);
}

std::vector<double> sample_quantiles(const Volume& volume, std::span<const double> fractions) {
  return std::visit(
      [&](const auto& s) {
        return s.empty() ? std::vector<double>(fractions.size(), 0.0) : quantiles_of(s, fractions);
      },
      volume.samples);
}

}  // namespace quincunx

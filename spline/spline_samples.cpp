#include "spline/spline_samples.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "lattice/error.h"
#include "lattice/memory.h"
#include "lattice/shared_progress.h"

namespace quincunx {
namespace {

template <class T>
T rounded(double value) {
  if constexpr (std::is_floating_point_v<T>) return T(value);
  return T(std::clamp(std::nearbyint(value), double(std::numeric_limits<T>::lowest()), double(std::numeric_limits<T>::max())));
}

Volume::Samples empty_samples(SampleType type) {
  switch (type) {
    case SampleType::uint8: return std::vector<std::uint8_t>{};
    case SampleType::int16: return std::vector<std::int16_t>{};
    case SampleType::uint16: return std::vector<std::uint16_t>{};
    case SampleType::float32: break;
  }
  return std::vector<float>{};
}

}  // namespace

Volume spline_samples(const Spline& spline, const Coefficients<double>& c, const TargetGrid& grid, SampleType type, const Progress& progress) {
  const std::uint64_t count = checked_sample_count(grid.lattice, grid.extents, type, "--dims");
  check_fits_memory(count * sample_type_bytes(type), "--dims");
  Volume volume{grid.lattice, grid.extents, grid.world, empty_samples(type), {}};
  const glm::dvec3 steps = relative_steps(grid, c.world), far(domain_max(c.lattice, c.extents));
  const std::int64_t step = lattice_step(grid.lattice), rows = coset_count(grid.lattice) * grid.extents.z * grid.extents.y;
  SharedProgress shared(progress, rows);
  std::atomic<bool> fits = true;
  std::visit(
      [&](auto& samples) {
        using T = typename std::decay_t<decltype(samples)>::value_type;
        samples.resize(std::size_t(count));
        tbb::parallel_for(std::int64_t(0), rows, [&](std::int64_t row) {
          const std::int64_t j = row % grid.extents.y, k = row / grid.extents.y % grid.extents.z, coset = row / grid.extents.y / grid.extents.z;
          for (std::int64_t i = 0; i < grid.extents.x; ++i) {
            const glm::dvec3 u = steps * glm::dvec3(step * glm::i64vec3(i, j, k) + coset);
            const double value = spline.evaluate(c, glm::clamp(u, glm::dvec3(0.0), far)).value;
            if (!(std::abs(value) <= double(std::numeric_limits<float>::max()))) fits = false;
            samples[std::size_t(row * grid.extents.x + i)] = rounded<T>(value);
          }
          shared.add(1);
        });
      },
      volume.samples);
  if (!fits) throw InputError(fmt::format("volume: the spline {} of these samples is too large for 32-bit floats", spline.name()));
  report(progress, 1.0);
  return volume;
}

}  // namespace quincunx

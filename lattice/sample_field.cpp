#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "lattice/field.h"
#include "lattice/memory.h"

namespace quincunx {
namespace {

/// The world in which the domain's box [0, domain_max] spans [-1,1] along each axis.
World cube_world(LatticeKind lattice, const Extents& extents) {
  const glm::dvec3 top(domain_max(lattice, extents));
  World world;
  for (int axis = 0; axis < 3; ++axis) {
    if (top[axis] == 0.0) continue;  // a single layer: stands at 0, unit step
    world.origin[axis] = -1.0;
    world.axes[axis][axis] = 2.0 / top[axis];
  }
  return world;
}

/// Samples row number `row` (coset slowest, then k, then j) of the volume into `out`.
void sample_row(const Field& field, const Volume& volume, std::int64_t row, float* out) {
  const Extents& n = volume.extents;
  const std::int64_t j = row % n.y, k = row / n.y % n.z, coset = row / n.y / n.z;
  const std::int64_t step = lattice_step(volume.lattice);
  for (std::int64_t i = 0; i < n.x; ++i) {
    const glm::dvec3 u(step * glm::i64vec3(i, j, k) + coset);
    out[i] = float(field.value(volume.world.to_world(u)));
  }
}

}  // namespace

Volume sample_field(const Field& field, LatticeKind lattice, const Extents& extents, const Progress& progress) {
  const std::uint64_t count = checked_sample_count(lattice, extents, SampleType::float32, "dimensions");
  check_fits_memory(count * sizeof(float), "dimensions");

  Volume volume;
  volume.lattice = lattice;
  volume.extents = extents;
  volume.world = cube_world(lattice, extents);
  std::vector<float> samples(count);

  // Sample a batch of rows at a time, each in parallel; between them the caller's thread reports.
  const std::int64_t rows = std::int64_t(count) / extents.x;
  const std::int64_t batch = std::max<std::int64_t>(1, (1 << 18) / extents.x);
  for (std::int64_t begin = 0; begin < rows; begin += batch) {
    report(progress, double(begin) / double(rows));
    tbb::parallel_for(begin, std::min(begin + batch, rows),
                      [&](std::int64_t row) { sample_row(field, volume, row, samples.data() + row * extents.x); });
  }
  report(progress, 1.0);
  volume.samples = std::move(samples);
  return volume;
}

}  // namespace quincunx

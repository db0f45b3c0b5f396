#include "accel/void_cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace quincunx {
namespace {

constexpr std::int64_t kBrick = 4;

/// Cells low <= x <= high in one row of those that a sample's weight reaches, from the sample's own place.
struct ReachedRow {
  std::int64_t y, z, low, high;
};

/// Whether the sample at 0 has a weight in the cell with this lower corner. A generator is 0 on knot planes only, inside its support, whose
/// sides are such planes: a piece has a weight everywhere or nowhere, and each piece of a cell holds one of these 4^3 points.
bool reaches(const Spline& spline, const glm::dvec3& corner) {
  for (int n = 0; n < 64; ++n)
    if (spline.generator(corner + 0.125 + 0.25 * glm::dvec3(n & 3, n >> 2 & 3, n >> 4)).value != 0.0) return true;
  return false;
}

std::vector<ReachedRow> reached_rows(const Spline& spline) {
  // A sample that reaches the domain is at most `apron` samples outside it: no weight is wider than that.
  const std::int64_t step = lattice_step(spline.lattice()), far = step * (spline.apron() + 1);
  std::vector<ReachedRow> rows;
  for (std::int64_t z = -far; z < far; ++z)
    for (std::int64_t y = -far; y < far; ++y) {
      ReachedRow row{y, z, far, -far};
      for (std::int64_t x = -far; x < far; ++x)
        if (reaches(spline, glm::dvec3(x, y, z))) row.low = std::min(row.low, x), row.high = x;
      // Supports are convex, and as wide as samples are apart: rows of samples side by side leave no gap.
      assert(row.low > row.high || row.high - row.low + 1 >= step);
      if (row.low <= row.high) rows.push_back(row);
    }
  return rows;
}

/// Sets the cells first <= x <= last of a row; threads may set bits of one brick at the same time.
void set_row(VoidCells& voids, std::int64_t first, std::int64_t last, std::int64_t y, std::int64_t z) {
  std::uint64_t* words = voids.words.data() + (z / kBrick * voids.bricks.y + y / kBrick) * voids.bricks.x;
  const std::int64_t shift = z % kBrick * 16 + y % kBrick * 4;
  for (std::int64_t brick = first / kBrick; brick <= last / kBrick; ++brick) {
    const std::int64_t from = std::max<std::int64_t>(first - brick * kBrick, 0), to = std::min<std::int64_t>(last - brick * kBrick, kBrick - 1);
    const std::uint64_t bits = ((2u << to) - (1u << from));
    std::atomic_ref(words[brick]).fetch_or(bits << shift, std::memory_order_relaxed);
  }
}

/// Sets the cells that samples first..last of a row reach; the first one stands at `u`, lattice coordinates.
void set_reached(VoidCells& voids, const std::vector<ReachedRow>& rows, const glm::i64vec3& u, std::int64_t length) {
  for (const ReachedRow& row : rows) {
    const std::int64_t y = u.y + row.y, z = u.z + row.z;
    if (y < 0 || y >= voids.cells.y || z < 0 || z >= voids.cells.z) continue;
    const std::int64_t first = std::max<std::int64_t>(u.x + row.low, 0), last = std::min(u.x + length + row.high, voids.cells.x - 1);
    if (first <= last) set_row(voids, first, last, y, z);
  }
}

}  // namespace

VoidCells void_cells(const Spline& spline, const Volume& volume) {
  assert(spline.lattice() == volume.lattice);
  VoidCells voids;
  voids.cells = cell_count(volume.lattice, volume.extents);
  voids.bricks = (voids.cells + (kBrick - 1)) / kBrick;
  if (!may_not_be_finite(volume) || sample_range(volume).not_finite == 0) return voids;
  voids.words.resize(std::size_t(voids.bricks.x * voids.bricks.y * voids.bricks.z));

  const auto& samples = std::get<std::vector<float>>(volume.samples);
  const std::vector<ReachedRow> rows = reached_rows(spline);
  const std::int64_t step = lattice_step(volume.lattice);
  const Extents& n = volume.extents;
  tbb::parallel_for(std::int64_t(0), coset_count(volume.lattice) * n.z, [&](std::int64_t plane) {
    const std::int64_t coset = plane / n.z, k = plane % n.z;
    for (std::int64_t j = 0; j < n.y; ++j) {
      const float* row = samples.data() + (plane * n.y + j) * n.x;
      const auto finite = [](float f) { return std::isfinite(f); };
      for (const float *begin = row, *end = row; (begin = std::find_if_not(end, row + n.x, finite)) != row + n.x;) {
        end = std::find_if(begin, row + n.x, finite);
        set_reached(voids, rows, step * glm::i64vec3(begin - row, j, k) + coset, step * (end - begin - 1));
      }
    }
  });
  for (const std::uint64_t word : voids.words) voids.count += std::uint64_t(std::popcount(word));
  return voids;
}

VoidCells make_finite(Volume& volume, const Spline& spline, const NanPolicy& policy) {
  VoidCells voids;
  if (policy.kind == NanPolicy::Kind::fill) fill_not_finite(volume, policy.value);
  if (policy.kind != NanPolicy::Kind::empty) return voids;
  voids = void_cells(spline, volume);
  if (!voids.words.empty()) extend_finite(volume);
  return voids;
}

void leave_out(const VoidCells& voids, CellBounds& bounds) {
  if (voids.count == 0) return;
  assert(voids.cells == bounds.cells);
  tbb::parallel_for(std::int64_t(0), voids.cells.y * voids.cells.z, [&](std::int64_t row) {
    glm::i64vec3 cell(0, row % voids.cells.y, row / voids.cells.y);
    for (; cell.x < voids.cells.x; ++cell.x)
      if (voids.at(cell)) bounds.min[bounds.number(cell)] = 65535, bounds.max[bounds.number(cell)] = 0;
  });
}

}  // namespace quincunx

#include "accel/streamed_bounds.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>

#include "lattice/shared_progress.h"
#include "spline/box_coefficients.h"

namespace quincunx {
namespace {

constexpr std::int64_t kLong = 512, kHigh = 64;  // cells of a box along x, and along y and z: multiples of kMostBlock
constexpr int kMostBlock = 64;                   // larger blocks are made of these
constexpr double kRangePart = 0.2;               // of the progress

/// The bounds of the cells from `low` on, and perhaps some more, from the samples that matter to them.
CellBounds box_bounds(const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, const BoundsScale& scale,
                      const glm::i64vec3& low, const glm::i64vec3& cells) {
  const std::int64_t step = lattice_step(spline.lattice());
  Coefficients<float> c;
  c.lattice = spline.lattice();
  c.extents = (cells + step - std::int64_t(1)) / step + std::int64_t(1);  // the corners of these cells
  c.apron = spline.apron();
  c.data.resize(std::size_t(coset_count(c.lattice) * c.stride_coset()));
  box_coefficients(source, spline, prefilter, {low / step - std::int64_t(c.apron), c.padded()}, c.data);
  return cell_bounds(spline, c, scale);
}

/// Widens the blocks by the bounds of their cells: those of the box low <= cell < low + cells.
void widen(const CellBounds& bounds, const glm::i64vec3& low, const glm::i64vec3& cells, BlockBounds& blocks) {
  for (std::int64_t z = 0; z < cells.z; ++z)
    for (std::int64_t y = 0; y < cells.y; ++y) {
      const glm::i64vec3 block = (low + glm::i64vec3(0, y, z)) / std::int64_t(blocks.block);
      std::size_t to = std::size_t((block.z * blocks.blocks.y + block.y) * blocks.blocks.x + block.x);
      const std::size_t row = bounds.number({0, y, z});
      for (std::int64_t x = 0; x < cells.x; x += blocks.block, ++to) {
        const std::size_t first = row + std::size_t(x), end = row + std::size_t(std::min(x + blocks.block, cells.x));
        blocks.min[to] = std::min(blocks.min[to], *std::min_element(bounds.min.data() + first, bounds.min.data() + end));
        blocks.max[to] = std::max(blocks.max[to], *std::max_element(bounds.max.data() + first, bounds.max.data() + end));
      }
    }
}

/// Blocks of at most kMostBlock cells.
BlockBounds small_blocks(const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, const BoundsScale& scale, int block,
                         const Progress& progress) {
  const glm::i64vec3 cells = cell_count(source.header().lattice, source.header().extents);
  BlockBounds blocks{block, (cells + std::int64_t(block - 1)) / std::int64_t(block), {}, {}};
  blocks.min.assign(std::size_t(blocks.blocks.x * blocks.blocks.y * blocks.blocks.z), 65535);
  blocks.max.assign(blocks.min.size(), 0);
  const glm::i64vec3 size(kLong, kHigh, kHigh), boxes = (cells + size - std::int64_t(1)) / size;
  SharedProgress shared(progress, boxes.x * boxes.y * boxes.z);
  tbb::parallel_for(std::int64_t(0), boxes.x * boxes.y * boxes.z, [&](std::int64_t n) {
    const glm::i64vec3 low = size * glm::i64vec3(n % boxes.x, n / boxes.x % boxes.y, n / (boxes.x * boxes.y));
    const glm::i64vec3 in_box = glm::min(size, cells - low);
    // Isolated: a thread that waits inside must not begin another box, whose memory would come on top.
    tbb::this_task_arena::isolate([&] { widen(box_bounds(source, spline, prefilter, scale, low, in_box), low, in_box, blocks); });
    shared.add(1);
  });
  return blocks;
}

}  // namespace

StreamedBounds streamed_bounds(const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, int block,
                               std::string_view what, const Progress& progress) {
  const Volume& header = source.header();
  assert(header.lattice == spline.lattice());
  check_block(block);
  StreamedBounds bounds;
  bounds.samples = sample_range(source, [&](double fraction) { report(progress, kRangePart * fraction); });
  check_finite(bounds.samples, header, what);
  bounds.scale = bounds_scale(spline, bounds.samples.min, bounds.samples.max, cell_count(header.lattice, header.extents));
  bounds.blocks = small_blocks(source, spline, prefilter, bounds.scale, std::min(block, kMostBlock),
                               [&](double fraction) { report(progress, kRangePart + (1.0 - kRangePart) * fraction); });
  if (block > kMostBlock) bounds.blocks = coarser(bounds.blocks, block);
  report(progress, 1.0);
  return bounds;
}

}  // namespace quincunx

#include "accel/streamed_bounds.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "accel/brick_errors.h"
#include "lattice/shared_progress.h"
#include "spline/box_coefficients.h"

namespace quincunx {
namespace {

constexpr std::int64_t kLong = 512, kHigh = 64;  // cells of a box along x, and along y and z: multiples of kMostBlock
constexpr int kMostBlock = 64;                   // larger blocks are made of these
constexpr double kRangePart = 0.2;               // of the progress

/// What all boxes share.
struct Task {
  const SampleSource& source;
  const Spline& spline;
  Spline::Prefilter prefilter;
  const ValueUnit& unit;
  const BoundsScale& scale;
  BrickErrors* errors;  ///< null where coefficients are not rounded
};

/// Cells more on each side of a box: those at its ends are bounded as if there were anything beyond. Even on the BCC lattice, whose boxes begin at even cells.
std::int64_t ring(const Spline& spline) { return spline.lattice() == LatticeKind::cartesian ? spline.apron() + 1 : spline.polynomial() ? 0 : 2; }

/// The index of the first coefficient of a box's.
glm::i64vec3 first_of_box(const Spline& spline, const glm::i64vec3& low) {
  return (low - ring(spline)) / std::int64_t(lattice_step(spline.lattice())) - std::int64_t(spline.apron());
}

/// The coefficients of the cells low - ring <= cell < low + cells + ring, perhaps of some more.
Coefficients<float> box_of(const Task& task, const glm::i64vec3& low, const glm::i64vec3& cells) {
  const Spline& spline = task.spline;
  const std::int64_t step = lattice_step(spline.lattice()), more = ring(spline);
  Coefficients<float> c;
  c.lattice = spline.lattice();
  c.extents = (cells + 2 * more + step - std::int64_t(1)) / step + std::int64_t(1);  // the corners of these cells
  c.apron = spline.apron();
  c.data.resize(std::size_t(coset_count(c.lattice) * c.stride_coset()));
  box_coefficients(task.source, spline, task.prefilter, task.unit, {first_of_box(spline, low), c.padded()}, c.data);
  return c;
}

/// Widens a block.
void widen(BlockBounds& blocks, std::size_t number, std::uint16_t min, std::uint16_t max) {
  blocks.min[number] = std::min(blocks.min[number], min);
  blocks.max[number] = std::max(blocks.max[number], max);
}

/// Calls row(first, size, block) for the rows of the cells low <= cell < low + cells: the cell `first` relative to low, how many there are
/// along x, and the number of the block that the row begins in.
template <class Row>
void for_each_row(const glm::i64vec3& low, const glm::i64vec3& cells, const BlockBounds& blocks, const Row& row) {
  for (std::int64_t z = 0; z < cells.z; ++z)
    for (std::int64_t y = 0; y < cells.y; ++y) {
      const glm::i64vec3 block = (low + glm::i64vec3(0, y, z)) / std::int64_t(blocks.block);
      row(glm::i64vec3(0, y, z), cells.x, std::size_t((block.z * blocks.blocks.y + block.y) * blocks.blocks.x + block.x));
    }
}

/// Widens the blocks by the bounds of the cells low <= cell < low + cells.
void widen_by_box(const CellBounds& bounds, std::int64_t more, const glm::i64vec3& low, const glm::i64vec3& cells, BlockBounds& blocks) {
  for_each_row(low, cells, blocks, [&](const glm::i64vec3& cell, std::int64_t size, std::size_t block) {
    const std::size_t row = bounds.number(cell + more);
    for (std::int64_t x = 0; x < size; x += blocks.block, ++block) {
      const std::size_t first = row + std::size_t(x), end = row + std::size_t(std::min(x + blocks.block, size));
      widen(blocks, block, *std::min_element(bounds.min.data() + first, bounds.min.data() + end),
            *std::max_element(bounds.max.data() + first, bounds.max.data() + end));
    }
  });
}

/// The same where all coefficients of the box are equal, as in empty surroundings: one cell stands for all.
void widen_by_constant(const Spline& spline, const Coefficients<float>& box, const BoundsScale& scale, const glm::i64vec3& low,
                       const glm::i64vec3& cells, BlockBounds& blocks) {
  Coefficients<float> c;
  c.lattice = box.lattice;
  c.extents = Extents(2 * ring(spline) + 2);
  c.apron = box.apron;
  c.data.assign(std::size_t(coset_count(c.lattice) * c.stride_coset()), box.data[0]);
  const CellBounds bounds = cell_bounds(spline, c, scale);
  const std::size_t middle = bounds.number(glm::i64vec3(ring(spline)));
  for_each_row(low, cells, blocks, [&](const glm::i64vec3&, std::int64_t size, std::size_t block) {
    for (std::int64_t x = 0; x < size; x += blocks.block, ++block) widen(blocks, block, bounds.min[middle], bounds.max[middle]);
  });
}

/// Widens the blocks by the box low <= cell < low + cells.
void add_box(const Task& task, const glm::i64vec3& low, const glm::i64vec3& cells, BlockBounds& blocks) {
  const Coefficients<float> c = box_of(task, low, cells);
  if (task.errors) task.errors->add(c, first_of_box(task.spline, low));
  if (std::all_of(c.data.begin(), c.data.end(), [&](float f) { return f == c.data[0]; })) {
    widen_by_constant(task.spline, c, task.scale, low, cells, blocks);
  } else {
    widen_by_box(cell_bounds(task.spline, c, task.scale), ring(task.spline), low, cells, blocks);
  }
}

/// Widens each block by what rounding its brick's coefficients, and those of the bricks beside it, may add.
void widen_by_errors(const Spline& spline, const BoundsScale& scale, const BrickLayout& layout, const BrickErrors& errors, BlockBounds& blocks) {
  assert(blocks.block <= layout.edge);
  const std::vector<double> largest = errors.errors();
  const std::int64_t per_brick = layout.edge / blocks.block;
  for (std::int64_t z = 0; z < blocks.blocks.z; ++z)
    for (std::int64_t y = 0; y < blocks.blocks.y; ++y)
      for (std::int64_t x = 0; x < blocks.blocks.x; ++x) {
        const double wider = value_error(spline, scale, largest[std::size_t(layout.number(glm::ivec3(x / per_brick, y / per_brick, z / per_brick)))]);
        const double steps = std::min(std::ceil(wider / scale.step * (1.0 + 1e-9)), 65535.0);
        const std::size_t n = std::size_t((z * blocks.blocks.y + y) * blocks.blocks.x + x);
        blocks.min[n] = std::uint16_t(std::max(double(blocks.min[n]) - steps, 0.0));
        blocks.max[n] = std::uint16_t(std::min(double(blocks.max[n]) + steps, 65535.0));
      }
}

/// The largest error of any brick's coefficients, those that `gain` may make of numbers from low to high.
double largest_error(Storage storage, double gain, double low, double high) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low) * gain;
  return storage_error(storage, middle - half, middle + half);
}

/// Blocks of at most kMostBlock cells.
BlockBounds small_blocks(const Task& task, int block, const Progress& progress) {
  const SampleSource& source = task.source;
  const glm::i64vec3 cells = cell_count(source.header().lattice, source.header().extents);
  BlockBounds blocks{block, (cells + std::int64_t(block - 1)) / std::int64_t(block), {}, {}};
  blocks.min.assign(std::size_t(blocks.blocks.x * blocks.blocks.y * blocks.blocks.z), 65535);
  blocks.max.assign(blocks.min.size(), 0);
  const glm::i64vec3 size(kLong, kHigh, kHigh), boxes = (cells + size - std::int64_t(1)) / size;
  SharedProgress shared(progress, boxes.x * boxes.y * boxes.z);
  tbb::parallel_for(std::int64_t(0), boxes.x * boxes.y * boxes.z, [&](std::int64_t n) {
    const glm::i64vec3 low = size * glm::i64vec3(n % boxes.x, n / boxes.x % boxes.y, n / (boxes.x * boxes.y));
    // Isolated: a thread that waits inside must not begin another box, whose memory would come on top.
    tbb::this_task_arena::isolate([&] { add_box(task, low, glm::min(size, cells - low), blocks); });
    shared.add(1);
  });
  return blocks;
}

}  // namespace

StreamedBounds streamed_bounds(const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, int block,
                               std::string_view what, const Progress& progress, const std::optional<SampleRange>& known, const BrickLayout* bricks) {
  const Volume& header = source.header();
  assert(header.lattice == spline.lattice());
  check_block(block);
  StreamedBounds bounds;
  bounds.samples = known ? *known : sample_range(source, [&](double fraction) { report(progress, kRangePart * fraction); });
  check_finite(bounds.samples, header, what);
  bounds.unit = float_unit(header.type(), bounds.samples.min, bounds.samples.max);
  const bool rounds = bricks && bricks->storage != Storage::float32;
  const double low = bounds.unit.number(bounds.samples.min), high = bounds.unit.number(bounds.samples.max);
  const double error = rounds ? largest_error(bricks->storage, spline.filter(prefilter).gain, low, high) : 0.0;
  bounds.scale = bounds_scale(spline, prefilter, low - error, high + error, cell_count(header.lattice, header.extents));
  std::optional<BrickErrors> errors;
  if (rounds) errors.emplace(*bricks);
  bounds.blocks = small_blocks({source, spline, prefilter, bounds.unit, bounds.scale, errors ? &*errors : nullptr}, std::min(block, kMostBlock),
                               [&](double fraction) { report(progress, kRangePart + (1.0 - kRangePart) * fraction); });
  if (errors) widen_by_errors(spline, bounds.scale, *bricks, *errors, bounds.blocks);
  if (block > kMostBlock) bounds.blocks = coarser(bounds.blocks, block);
  report(progress, 1.0);
  return bounds;
}

}  // namespace quincunx

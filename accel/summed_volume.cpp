#include "accel/summed_volume.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cassert>

#include "lattice/error.h"

namespace quincunx {
namespace {

glm::ivec3 checked_size(const glm::i64vec3& blocks) {
  // In double, exact up to 2^53 and far from 2^32 beyond.
  if (double(blocks.x) * double(blocks.y) * double(blocks.z) >= 0x1p32)
    throw InputError(fmt::format("--block: found {} x {} x {} blocks, expected fewer than 2^32: larger ones", blocks.x, blocks.y,
                                 blocks.z));
  return glm::ivec3(blocks);
}

}  // namespace

SummedVolume::SummedVolume(const Classification& blocks) : blocks_(checked_size(blocks.blocks)) {
  const std::size_t nx = std::size_t(blocks_.x), ny = std::size_t(blocks_.y), nz = std::size_t(blocks_.z);
  const std::size_t row = nx + 1, slice = row * (ny + 1);
  sums_.resize(slice * (nz + 1));
  // Sum each slice over x and y; the first row and the first entry of each row stay 0.
  tbb::parallel_for(std::size_t(0), nz, [&](std::size_t z) {
    for (std::size_t y = 0; y < ny; ++y) {
      const std::uint8_t* level = blocks.level.data() + (z * ny + y) * nx;
      std::uint32_t* sum = sums_.data() + (z + 1) * slice + (y + 1) * row;
      const std::uint32_t* before = sum - row;
      std::uint32_t here = 0;
      for (std::size_t x = 0; x < nx; ++x) {
        here += level[x] == Classification::active;
        sum[x + 1] = before[x + 1] + here;
      }
    }
  });
  // Add the slices up over z, row by row.
  tbb::parallel_for(std::size_t(1), ny + 1, [&](std::size_t y) {
    for (std::size_t z = 1; z < nz; ++z) {
      const std::uint32_t* before = sums_.data() + z * slice + y * row;
      std::uint32_t* sum = sums_.data() + (z + 1) * slice + y * row;
      for (std::size_t x = 1; x < row; ++x) sum[x] += before[x];
    }
  });
}

std::uint32_t SummedVolume::at(int x, int y, int z) const {
  const std::size_t row = std::size_t(blocks_.x) + 1, rows = std::size_t(blocks_.y) + 1;
  return sums_[(std::size_t(z) * rows + std::size_t(y)) * row + std::size_t(x)];
}

std::uint32_t SummedVolume::count(const BlockBox& box) const {
  const glm::ivec3 a = box.low, b = box.high;
  assert(a.x >= 0 && a.y >= 0 && a.z >= 0 && a.x <= b.x && a.y <= b.y && a.z <= b.z);
  assert(b.x <= blocks_.x && b.y <= blocks_.y && b.z <= blocks_.z);
  // Inclusion and exclusion; unsigned differences are right whatever wraps on the way.
  const std::uint32_t above = at(b.x, b.y, b.z) - at(a.x, b.y, b.z) - at(b.x, a.y, b.z) + at(a.x, a.y, b.z);
  const std::uint32_t below = at(b.x, b.y, a.z) - at(a.x, b.y, a.z) - at(b.x, a.y, a.z) + at(a.x, a.y, a.z);
  return above - below;
}

BlockBox SummedVolume::trimmed(const BlockBox& box) const {
  if (empty(box)) return {box.low, box.low};
  BlockBox tight = box;
  for (int axis = 0; axis < 3; ++axis) {
    // [box.low, first) is empty, [box.low, first + 1) is not.
    BlockBox slab = tight;
    int first = tight.low[axis], beyond = tight.high[axis];
    while (beyond - first > 1) {
      slab.high[axis] = first + (beyond - first) / 2;
      (empty(slab) ? first : beyond) = slab.high[axis];
    }
    tight.low[axis] = first;
    // [last, box.high) is empty, [last - 1, box.high) is not.
    slab = tight;
    int last = tight.high[axis], before = tight.low[axis];
    while (last - before > 1) {
      slab.low[axis] = last - (last - before) / 2;
      (empty(slab) ? last : before) = slab.low[axis];
    }
    tight.high[axis] = last;
  }
  return tight;
}

}  // namespace quincunx

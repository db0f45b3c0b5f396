#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "accel/cluster.h"

namespace quincunx {
namespace {

using Word = std::uint64_t;
constexpr int kWord = 64;

/// The active blocks that are in no box yet, a bit each: rows along x from the lowest bit of their first word on, bits behind a
/// row's end 0.
class FreeBlocks {
 public:
  explicit FreeBlocks(const Classification& blocks)
      : blocks_(blocks.blocks), row_words_(std::size_t((blocks_.x + kWord - 1) / kWord)) {
    const std::size_t rows = std::size_t(blocks_.y) * std::size_t(blocks_.z), nx = std::size_t(blocks_.x);
    words_.resize(row_words_ * rows);
    tbb::parallel_for(std::size_t(0), rows, [&](std::size_t r) {
      const std::uint8_t* level = blocks.level.data() + r * nx;
      Word* row = words_.data() + r * row_words_;
      for (std::size_t x = 0; x < nx; ++x) row[x / kWord] |= Word(level[x] == Classification::active) << x % kWord;
    });
  }

  const glm::ivec3& blocks() const { return blocks_; }

  /// The first free block of the row with x or more; blocks().x where there is none.
  int first(int x, int y, int z) const {
    for (; x < blocks_.x; x = (x / kWord + 1) * kWord)
      if (const Word rest = word(x, y, z) >> x % kWord) return x + std::countr_zero(rest);
    return blocks_.x;
  }
  /// The first block of the row with x or more that is not free, or `end`.
  int run_end(int x, int y, int z, int end) const {
    while (x < end) {
      const int ones = std::countr_one(word(x, y, z) >> x % kWord);
      x += ones;
      if (x % kWord != 0 || ones == 0) break;
    }
    return std::min(x, end);
  }
  bool free(int begin, int end, int y, int z) const { return run_end(begin, y, z, end) == end; }

  void remove(const BlockBox& box) {
    for (int z = box.low.z; z < box.high.z; ++z)
      for (int y = box.low.y; y < box.high.y; ++y) remove(box.low.x, box.high.x, y, z);
  }

 private:
  std::size_t number(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(blocks_.y) + std::size_t(y)) * row_words_ + std::size_t(x / kWord);
  }
  Word word(int x, int y, int z) const { return words_[number(x, y, z)]; }
  void remove(int begin, int end, int y, int z) {
    for (int x = begin; x < end; x = (x / kWord + 1) * kWord) {
      const int count = std::min(end - x, kWord - x % kWord);
      words_[number(x, y, z)] &= ~(~Word(0) >> (kWord - count) << x % kWord);
    }
  }

  glm::ivec3 blocks_;
  std::size_t row_words_;
  std::vector<Word> words_;
};

/// The box with the low corner (x,y,z), free, as long as free blocks go along x, then as wide along y, then as high along z.
BlockBox grown(const FreeBlocks& blocks, int x, int y, int z) {
  const glm::ivec3 n = blocks.blocks();
  BlockBox box{{x, y, z}, {blocks.run_end(x, y, z, n.x), y + 1, z + 1}};
  const auto row_free = [&](int row, int slice) { return blocks.free(box.low.x, box.high.x, row, slice); };
  const auto slice_free = [&](int slice) {
    for (int row = box.low.y; row < box.high.y; ++row)
      if (!row_free(row, slice)) return false;
    return true;
  };
  while (box.high.y < n.y && row_free(box.high.y, z)) ++box.high.y;
  while (box.high.z < n.z && slice_free(box.high.z)) ++box.high.z;
  return box;
}

}  // namespace

// No block before the first free one is free, so every box of free blocks around it has it as low corner: there is nothing to
// gain by growing backwards. Other orders of growth, or the largest box of all, give about as many boxes and take longer.
std::vector<BlockBox> cluster_boxes(const Classification& blocks) {
  FreeBlocks free(blocks);
  const glm::ivec3 n = free.blocks();
  std::vector<BlockBox> boxes;
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = free.first(0, y, z); x < n.x; x = free.first(x, y, z)) {
        boxes.push_back(grown(free, x, y, z));
        free.remove(boxes.back());
        x = boxes.back().high.x;
      }
  return boxes;
}

}  // namespace quincunx

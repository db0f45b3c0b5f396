// The slots that hold bricks on the device, and the page table that says where a brick is.
//
// After Hadwiger, Beyer, Jeong, Pfister 2012 (accel/bricks.h): rays ask for the bricks they lack, and what was not needed for longest
// makes room.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "accel/bricks.h"
#include "lattice/progress.h"
#include "render/brick_source.h"

namespace quincunx {

/// Which brick is in which slot. What is in the slots themselves is the device's: the pool hands it to a callback.
/// One slot is enough for any sequence of requests.
class BrickPool {
 public:
  /// What the page table holds of a brick that is not resident; no origin has this value.
  static constexpr std::int32_t kNotResident = std::numeric_limits<std::int32_t>::min();

  /// Puts a brick's numbers, those of its slot, where the kernel finds them: from number `first` of the pool on. Called from the thread that calls
  /// make_resident, once for each slot that is filled.
  using Upload = std::function<void(std::int32_t brick, std::int64_t first, std::span<const float> slot)>;

  struct Counters {
    std::uint64_t loads = 0, evictions = 0, bytes = 0;  ///< since the pool was made; bytes: of slots as they are stored
    int resident = 0, peak = 0;                         ///< bricks
  };

  /// A pool of as many slots as fit `bytes`, at most one for each brick; all are empty. Throws InputError as BrickLayout::slots.
  BrickPool(const BrickLayout& layout, std::shared_ptr<const BrickSource> source, std::uint64_t bytes);

  const BrickLayout& layout() const { return layout_; }
  int slots() const { return int(slots_.size()); }
  std::int64_t floats() const { return slots() * layout_.slot_floats(); }
  /// One number a brick: BrickLayout::origin in its slot, or kNotResident.
  std::span<const std::int32_t> page_table() const { return page_table_; }
  const Counters& counters() const { return counters_; }

  /// Makes the first bricks of `needed` resident, as many as there are slots. `needed` has no number twice, front to back, and may
  /// name bricks that are resident already. Slots are taken from other bricks: empty ones first, then those not needed for longest, of
  /// those needed in one call the last. Bricks are filled in parallel, a few at a time. Returns those whose entry in the page table is
  /// another now, evicted or loaded, ascending. Where the source, `upload` or `progress` throws, the page table names just what was
  /// uploaded and not evicted before.
  std::vector<std::int32_t> make_resident(std::span<const std::int32_t> needed, const Upload& upload, const Progress& progress = {});

 private:
  struct Slot {
    std::int32_t brick = -1;   ///< -1: empty
    std::int64_t needed = -1;  ///< when last: larger is later, or further in front in the same call
  };
  struct Load {
    std::int32_t brick = -1;
    int slot = -1;
    std::int64_t needed = -1;  ///< as of the slot
  };

  /// Empties `count` slots, those needed least lately, and returns them; appends the bricks that were in them to `evicted`.
  std::vector<int> make_room(std::size_t count, std::vector<std::int32_t>& evicted);
  void load(std::span<const Load> loads, const Upload& upload, const Progress& progress);

  BrickLayout layout_;
  std::shared_ptr<const BrickSource> source_;
  std::vector<Slot> slots_;
  std::vector<std::int32_t> page_table_;
  std::vector<int> slot_of_;  ///< by brick; -1 where not resident
  std::int64_t clock_ = 0;
  Counters counters_;
};

}  // namespace quincunx

#include "render/brick_pool.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace quincunx {
namespace {

constexpr std::int64_t kBatchFloats = 1 << 23;  // filled in parallel before they are uploaded: 32 MiB, or one slot

}  // namespace

BrickPool::BrickPool(const BrickLayout& layout, std::shared_ptr<const BrickSource> source, std::uint64_t bytes)
    : layout_(layout), source_(std::move(source)), slots_(std::size_t(layout.slots(bytes))),
      page_table_(std::size_t(layout.count()), kNotResident), slot_of_(std::size_t(layout.count()), -1) {}

std::vector<int> BrickPool::make_room(std::size_t count, std::vector<std::int32_t>& evicted) {
  std::vector<int> slots(slots_.size());
  std::iota(slots.begin(), slots.end(), 0);
  const auto last = slots.begin() + std::ptrdiff_t(count);
  std::partial_sort(slots.begin(), last, slots.end(), [&](int a, int b) {
    return std::pair(slots_[std::size_t(a)].needed, a) < std::pair(slots_[std::size_t(b)].needed, b);
  });
  slots.erase(last, slots.end());
  for (const int s : slots) {
    Slot& slot = slots_[std::size_t(s)];
    if (slot.brick < 0) continue;
    evicted.push_back(slot.brick);
    page_table_[std::size_t(slot.brick)] = kNotResident;
    slot_of_[std::size_t(slot.brick)] = -1;
    slot = {};
    ++counters_.evictions;
    --counters_.resident;
  }
  return slots;
}

void BrickPool::load(std::span<const Load> loads, const Upload& upload, const Progress& progress) {
  const std::int64_t floats = layout_.slot_floats();
  const std::size_t batch = std::size_t(std::max<std::int64_t>(kBatchFloats / floats, 1));
  std::vector<float> staging(std::min(batch, loads.size()) * std::size_t(floats));
  for (std::size_t done = 0; done < loads.size(); done += batch) {
    report(progress, double(done) / double(loads.size()));
    const std::span<const Load> now = loads.subspan(done, std::min(batch, loads.size() - done));
    const auto staged = [&](std::size_t n) { return std::span(staging).subspan(n * std::size_t(floats), std::size_t(floats)); };
    tbb::parallel_for(std::size_t(0), now.size(), [&](std::size_t n) {
      // Isolated: a thread that waits inside must not begin another brick, whose samples would come on top.
      tbb::this_task_arena::isolate([&] { source_->fill(layout_.brick(now[n].brick), staged(n)); });
    });
    for (std::size_t n = 0; n < now.size(); ++n) {
      const auto& [brick, slot, needed] = now[n];
      upload(brick, slot * floats, staged(n));
      slots_[std::size_t(slot)] = {brick, needed};
      slot_of_[std::size_t(brick)] = slot;
      page_table_[std::size_t(brick)] = layout_.origin(layout_.brick(brick), slot);
      ++counters_.loads;
      counters_.bytes += layout_.slot_bytes();
      counters_.peak = std::max(counters_.peak, ++counters_.resident);
    }
  }
  report(progress, 1.0);
}

std::vector<std::int32_t> BrickPool::make_resident(std::span<const std::int32_t> needed, const Upload& upload, const Progress& progress) {
  needed = needed.first(std::min(needed.size(), slots_.size()));
  std::vector<Load> loads;
  for (std::size_t n = 0; n < needed.size(); ++n) {
    const int slot = slot_of_[std::size_t(needed[n])];
    const std::int64_t time = clock_ + std::int64_t(needed.size() - n);
    if (slot < 0) {
      loads.push_back({needed[n], -1, time});
    } else {
      slots_[std::size_t(slot)].needed = time;
    }
  }
  clock_ += std::int64_t(needed.size());
  if (loads.empty()) return {};

  // None of `needed` is emptied: there are enough other slots, all needed earlier.
  std::vector<std::int32_t> changed;
  const std::vector<int> room = make_room(loads.size(), changed);
  for (std::size_t n = 0; n < loads.size(); ++n) loads[n].slot = room[n];
  load(loads, upload, progress);
  for (const Load& l : loads) changed.push_back(l.brick);
  std::sort(changed.begin(), changed.end());
  return changed;
}

}  // namespace quincunx

#include "render/brick_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include "lattice/error.h"

namespace quincunx {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Slots filled with their brick's number.
class NumberedBricks final : public BrickSource {
 public:
  explicit NumberedBricks(const BrickLayout& layout) : layout_(layout) {}
  void fill(const glm::ivec3& brick, std::span<float> slot) const override {
    if (layout_.number(brick) == unreadable) throw InputError("brick cannot be read");
    std::fill(slot.begin(), slot.end(), float(layout_.number(brick)));
  }
  int unreadable = -1;

 private:
  BrickLayout layout_;
};

/// A pool of 4 x 3 x 2 bricks with its device: what was uploaded where.
struct PoolFixture {
  BrickLayout layout{LatticeKind::cartesian, {16, 12, 8}, 1, 4};
  std::shared_ptr<NumberedBricks> source = std::make_shared<NumberedBricks>(layout);
  BrickPool pool;
  std::vector<float> device;

  explicit PoolFixture(int slots)
      : pool(layout, source, std::uint64_t(slots) * layout.slot_bytes()), device(std::size_t(pool.floats()), -1.0f) {}

  BrickPool::Upload upload() {
    return [this](std::int32_t, std::int64_t first, std::span<const float> slot) {
      ASSERT_EQ(std::int64_t(slot.size()), layout.slot_floats());
      ASSERT_LE(first + std::int64_t(slot.size()), std::int64_t(device.size()));
      std::copy(slot.begin(), slot.end(), device.begin() + first);
    };
  }
  std::vector<std::int32_t> need(const std::vector<std::int32_t>& bricks) { return pool.make_resident(bricks, upload()); }

  /// The resident bricks; fails where an entry of the page table leads to anything but the whole of its brick.
  std::vector<std::int32_t> resident() const {
    std::vector<std::int32_t> found;
    for (std::int32_t n = 0; n < layout.count(); ++n) {
      const std::int64_t origin = pool.page_table()[std::size_t(n)];
      if (origin == BrickPool::kNotResident) continue;
      found.push_back(n);
      const glm::i64vec3 first = layout.first_index(layout.brick(n)), strides(layout.strides());
      const std::int64_t begin = origin + first.x + first.y * strides.x + first.z * strides.y;
      for (std::int64_t f = begin; f < begin + layout.slot_floats(); ++f) EXPECT_EQ(device.at(std::size_t(f)), float(n));
    }
    EXPECT_EQ(int(found.size()), pool.counters().resident);
    return found;
  }
};

TEST(BrickPool, BeginsEmptyWithASlotForEveryBrickThatFits) {
  PoolFixture f(5);
  EXPECT_EQ(f.pool.slots(), 5);
  EXPECT_THAT(f.resident(), IsEmpty());
  EXPECT_EQ(PoolFixture(1000).pool.slots(), 24);
}

TEST(BrickPool, RefusesToBeSmallerThanASlotAndSaysWhatWorks) {
  try {
    PoolFixture f(0);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--pool: found 0 bytes, expected at least 1372 bytes, one brick of 4 cells with its border");
  }
}

TEST(BrickPool, LoadsWhatIsNeededAndSaysWhichEntriesChanged) {
  PoolFixture f(3);
  EXPECT_THAT(f.need({7, 2}), ElementsAre(2, 7));
  EXPECT_THAT(f.resident(), ElementsAre(2, 7));
  EXPECT_THAT(f.need({2, 7}), IsEmpty());
  EXPECT_THAT(f.need({2, 9, 4}), ElementsAre(4, 7, 9));
  EXPECT_THAT(f.resident(), ElementsAre(2, 4, 9));
  EXPECT_THAT(f.need({}), IsEmpty());
  EXPECT_EQ(f.pool.counters().loads, 4u);
  EXPECT_EQ(f.pool.counters().evictions, 1u);
  EXPECT_EQ(f.pool.counters().bytes, 4 * f.layout.slot_bytes());
  EXPECT_EQ(f.pool.counters().peak, 3);
}

TEST(BrickPool, OfMoreThanFitTheFirstAreLoaded) {
  PoolFixture f(2);
  f.need({5, 1, 3, 0});
  EXPECT_THAT(f.resident(), ElementsAre(1, 5));
  // 5 is needed again, but 3 and 0 stand in front of it.
  f.need({3, 0, 5});
  EXPECT_THAT(f.resident(), ElementsAre(0, 3));
}

TEST(BrickPool, EvictsWhatWasNotNeededForLongestAndOfOneCallTheLast) {
  PoolFixture f(4);
  f.need({10, 11});
  f.need({12, 13});
  f.need({11});
  f.need({14});
  EXPECT_THAT(f.resident(), ElementsAre(11, 12, 13, 14)) << "10 was not needed for longest";
  f.need({15});
  EXPECT_THAT(f.resident(), ElementsAre(11, 12, 14, 15)) << "13 stood behind 12";
}

TEST(BrickPool, ABrickThatIsNeededButNoLongerFitsGoesAfterThoseThatAreNotNeeded) {
  PoolFixture f(3);
  f.need({1, 2, 3});
  f.need({8, 9, 1});
  EXPECT_THAT(f.resident(), ElementsAre(1, 8, 9));
  f.need({4, 5, 6, 9});
  EXPECT_THAT(f.resident(), ElementsAre(4, 5, 6));
  f.need({4, 7});
  f.need({0, 6, 4, 7});
  EXPECT_THAT(f.resident(), ElementsAre(0, 4, 6)) << "7 stood behind the three that fit";
}

TEST(BrickPool, OneSlotServesAnySequence) {
  PoolFixture f(1);
  std::mt19937 random(2);
  for (int n = 0; n < 200; ++n) {
    std::vector<std::int32_t> needed(24);
    std::iota(needed.begin(), needed.end(), 0);
    std::shuffle(needed.begin(), needed.end(), random);
    needed.resize(1 + random() % 5);
    f.need(needed);
    EXPECT_THAT(f.resident(), ElementsAre(needed[0]));
  }
  EXPECT_EQ(f.pool.counters().peak, 1);
}

/// The rules of the pool, one brick at a time: what is resident, and when each brick was last needed.
struct PoolModel {
  std::size_t slots;
  std::map<std::int32_t, std::pair<int, int>> resident;  ///< call, minus the place in it
  int calls = 0;

  void need(const std::vector<std::int32_t>& bricks) {
    ++calls;
    for (std::size_t n = 0; n < bricks.size(); ++n)
      if (resident.contains(bricks[n])) resident[bricks[n]] = {calls, -int(n)};
    for (std::size_t n = 0; n < std::min(bricks.size(), slots); ++n) {
      if (resident.contains(bricks[n])) continue;
      const auto earlier = [](const auto& a, const auto& b) { return a.second < b.second; };
      if (resident.size() == slots) resident.erase(std::min_element(resident.begin(), resident.end(), earlier));
      resident[bricks[n]] = {calls, -int(n)};
    }
  }
};

TEST(BrickPool, FollowsASimpleModelThroughRandomRequests) {
  std::mt19937 random(9);
  for (const int slots : {2, 5, 11, 24}) {
    PoolFixture f(slots);
    PoolModel model{std::size_t(slots), {}};
    for (int n = 0; n < 300; ++n) {
      std::vector<std::int32_t> needed(24);
      std::iota(needed.begin(), needed.end(), 0);
      std::shuffle(needed.begin(), needed.end(), random);
      needed.resize(random() % 9);
      const std::vector<std::int32_t> before(f.pool.page_table().begin(), f.pool.page_table().end());
      const std::vector<std::int32_t> changed = f.need(needed);
      model.need(needed);
      std::vector<std::int32_t> expected, expected_changed;
      for (const auto& [brick, time] : model.resident) expected.push_back(brick);
      ASSERT_EQ(f.resident(), expected) << "after " << n << " requests to " << slots << " slots";
      for (std::int32_t b = 0; b < 24; ++b)
        if (before[std::size_t(b)] != f.pool.page_table()[std::size_t(b)]) expected_changed.push_back(b);
      ASSERT_EQ(changed, expected_changed);
    }
  }
}

TEST(BrickPool, ManyBatchesAreLoadedWithProgress) {
  // Bricks of 256 cells: a batch is one of them.
  const BrickLayout layout(LatticeKind::bcc, {300, 2, 2}, 1, 256);
  ASSERT_EQ(layout.count(), 3);
  BrickPool pool(layout, std::make_shared<NumberedBricks>(layout), 3 * layout.slot_bytes());
  std::vector<double> fractions;
  int uploads = 0;
  pool.make_resident(std::vector<std::int32_t>{2, 0, 1}, [&](std::int32_t, std::int64_t, std::span<const float>) { ++uploads; },
                     [&](double fraction) { fractions.push_back(fraction); });
  EXPECT_EQ(uploads, 3);
  EXPECT_EQ(fractions.size(), 4u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(BrickPool, AfterAnErrorThePageTableNamesWhatIsThereAndWorkGoesOn) {
  PoolFixture f(3);
  f.need({1, 2, 3});
  f.source->unreadable = 6;
  EXPECT_THROW(f.need({5, 6}), InputError);
  EXPECT_THAT(f.resident(), ElementsAre(1)) << "2 and 3 made room";
  f.source->unreadable = -1;
  f.need({6, 5});
  EXPECT_THAT(f.resident(), ElementsAre(1, 5, 6));

  int uploads = 0;
  const BrickPool::Upload failing = [&](std::int32_t brick, std::int64_t first, std::span<const float> slot) {
    if (++uploads == 2) throw Interrupted();
    f.upload()(brick, first, slot);
  };
  EXPECT_THROW(f.pool.make_resident(std::vector<std::int32_t>{7, 8, 9}, failing), Interrupted);
  EXPECT_THAT(f.resident(), ElementsAre(7));
  EXPECT_THROW(f.pool.make_resident(std::vector<std::int32_t>{0}, f.upload(), [](double) { throw Interrupted(); }), Interrupted);
  f.need({7, 8, 9});
  EXPECT_THAT(f.resident(), ElementsAre(7, 8, 9));
}

}  // namespace
}  // namespace quincunx

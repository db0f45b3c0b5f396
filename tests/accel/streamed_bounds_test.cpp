#include "accel/streamed_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <random>
#include <vector>

#include "accel/brick_errors.h"
#include "lattice/error.h"
#include "spline/box_coefficients.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

/// Smooth waves with some noise, 0..255, and nothing beyond x = 100.
Volume waves(LatticeKind lattice, const Extents& extents) {
  Volume v{lattice, extents, {}, std::vector<std::uint8_t>{}, {}};
  std::mt19937 random(6);
  for (int c = 0; c < coset_count(lattice); ++c)
    for (std::int64_t k = 0; k < extents.z; ++k)
      for (std::int64_t j = 0; j < extents.y; ++j)
        for (std::int64_t i = 0; i < extents.x; ++i) {
          const double wave = std::sin(0.11 * double(i)) * std::cos(0.2 * double(j) + 0.3 * double(k));
          const double sample = i > 100 ? 7.0 : 120.0 + 100.0 * wave + double(random() % 30);
          std::get<std::vector<std::uint8_t>>(v.samples).push_back(std::uint8_t(sample));
        }
  return v;
}

/// More than one box along x and y, none divided by blocks; and axes of one sample.
std::vector<Extents> extents_of(LatticeKind lattice) {
  if (lattice == LatticeKind::bcc) return {{263, 38, 3}, {9, 1, 35}, {1, 1, 1}};
  return {{525, 70, 5}, {17, 1, 67}, {1, 1, 1}};
}

/// Calls check(spline, prefilter, volume) for all of them.
template <class Check>
void for_each_case(const Check& check) {
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    for (const Extents& extents : extents_of(spline->lattice()))
      for (const Spline::Filter& filter : spline->filters()) {
        SCOPED_TRACE(std::string(name) + ", " + std::string(prefilter_name(filter.kind)) + ", " + std::to_string(extents.x) + " samples along x");
        check(*spline, filter.kind, waves(spline->lattice(), extents));
      }
  }
}

TEST(StreamedBounds, HoldTheSplineAtRandomPoints) {
  for_each_case([](const Spline& spline, Spline::Prefilter prefilter, const Volume& volume) {
    const StreamedBounds bounds = streamed_bounds(VolumeSource(volume), spline, prefilter, 4, "volume");
    const Coefficients<double> c = spline.coefficients(volume, prefilter);
    const glm::dvec3 last(domain_max(volume.lattice, volume.extents));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int n = 0; n < 10'000; ++n) {
      const glm::dvec3 u = last * glm::dvec3(uniform(random), uniform(random), uniform(random));
      const double value = spline.evaluate(c, u).value;
      const glm::i64vec3 b = glm::i64vec3(cell_of(u, glm::i64vec3(last))) / std::int64_t(4);
      const std::size_t number = std::size_t((b.z * bounds.blocks.blocks.y + b.y) * bounds.blocks.blocks.x + b.x);
      ASSERT_LE(bounds.scale.value(bounds.blocks.min[number]), value);
      ASSERT_GE(bounds.scale.value(bounds.blocks.max[number]), value);
    }
  });
}

TEST(StreamedBounds, AreThoseOfTheWholeVolumeAndLittleWider) {
  for_each_case([](const Spline& spline, Spline::Prefilter prefilter, const Volume& volume) {
    const CellBounds cells = cell_bounds(spline, spline.coefficients_float(volume, prefilter));
    for (const int block : {1, 2, 8, 64, 128}) {
      const BlockBounds expected = block_bounds(cells, block);
      const StreamedBounds found = streamed_bounds(VolumeSource(volume), spline, prefilter, block, "volume");
      ASSERT_EQ(found.blocks.block, block);
      ASSERT_EQ(found.blocks.blocks, expected.blocks);
      const double wider = 4.0 * found.scale.step;
      for (std::size_t n = 0; n < expected.min.size(); ++n) {
        const double low = found.scale.value(found.blocks.min[n]), high = found.scale.value(found.blocks.max[n]);
        ASSERT_LE(low, cells.value(expected.min[n]) + cells.step);
        ASSERT_GE(low, cells.value(expected.min[n]) - wider) << "block " << n << " of " << block;
        ASSERT_GE(high, cells.value(expected.max[n]) - cells.step);
        ASSERT_LE(high, cells.value(expected.max[n]) + wider) << "block " << n << " of " << block;
      }
    }
  });
}

TEST(StreamedBounds, SayTheRangeOfTheSamplesAndTheScaleOfTheWholeVolume) {
  const auto spline = make_spline("bcc7");
  const Volume volume = waves(LatticeKind::bcc, {140, 40, 3});
  const StreamedBounds bounds = streamed_bounds(VolumeSource(volume), *spline, Spline::Prefilter::automatic, 8, "volume");
  const SampleRange samples = sample_range(volume);
  EXPECT_EQ(bounds.samples.min, samples.min);
  EXPECT_EQ(bounds.samples.max, samples.max);
  const BoundsScale scale = bounds_scale(*spline, Spline::Prefilter::automatic, samples.min, samples.max, cell_count(volume.lattice, volume.extents));
  EXPECT_EQ(bounds.scale.low, scale.low);
  EXPECT_EQ(bounds.scale.step, scale.step);
  EXPECT_EQ(bounds.scale.displacement, scale.displacement);
}

/// The coefficients of a brick's slot as a kernel decodes them.
Coefficients<double> decoded_slot(const Volume& volume, const Spline& spline, Spline::Prefilter prefilter, const BrickLayout& layout, const glm::ivec3& brick) {
  std::vector<float> slot(std::size_t(layout.slot_floats()));
  box_coefficients(VolumeSource(volume), spline, prefilter, {}, {layout.first_index(brick), Extents(layout.samples)}, slot);
  const NumberRange range = range_of(slot);
  const ValueUnit unit = storage_unit(layout.storage, range.low, range.high);
  Coefficients<double> c;
  c.lattice = layout.lattice;
  c.apron = layout.apron;
  c.extents = Extents(layout.samples - 2 * layout.apron);
  for (const float number : slot) {
    const float product = float(unit.scale) * stored_number(layout.storage, storage_bits(layout.storage, unit.number(number)));
    const float decoded = float(unit.offset) + product;
    c.data.push_back(decoded);
  }
  return c;
}

TEST(StreamedBounds, HoldWhatIsDecodedOfStoredBricksOnBothSidesOfTheirFaces) {
  std::size_t beyond_unrounded = 0;
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    const LatticeKind lattice = spline->lattice();
    const Volume volume = waves(lattice, lattice == LatticeKind::bcc ? Extents(70, 9, 6) : Extents(139, 18, 11));
    const glm::i64vec3 cells = cell_count(volume.lattice, volume.extents);
    const Spline::Prefilter prefilter = Spline::Prefilter::automatic;
    const StreamedBounds unrounded = streamed_bounds(VolumeSource(volume), *spline, prefilter, 4, "volume");
    for (const Storage storage : {Storage::float16, Storage::unorm16, Storage::unorm8})
      for (const int edge : {4, 16, 128}) {
        SCOPED_TRACE(std::string(name) + ", " + storage_name(storage) + ", bricks of " + std::to_string(edge));
        const BrickLayout layout(lattice, volume.extents, spline->apron(), edge, storage);
        const StreamedBounds bounds = streamed_bounds(VolumeSource(volume), *spline, prefilter, 4, "volume", {}, {}, &layout);
        std::mt19937 random(5);
        for (int n = 0; n < (edge == 4 ? 20 : 4); ++n) {
          const glm::ivec3 brick(int(random() % unsigned(layout.bricks.x)), int(random() % unsigned(layout.bricks.y)), int(random() % unsigned(layout.bricks.z)));
          const Coefficients<double> slot = decoded_slot(volume, *spline, prefilter, layout, brick);
          for (int k = 0; k < 300; ++k) {
            glm::i64vec3 cell;
            glm::dvec3 u;
            for (int a = 0; a < 3; ++a) {
              const std::int64_t first = brick[a] * std::int64_t(edge), count = std::min<std::int64_t>(edge, cells[a] - first);
              cell[a] = first + (k % 3 == a ? 0 : std::int64_t(random() % std::uint64_t(count)));
              u[a] = double(cell[a]) + (k % 3 == a ? 0.0 : std::uniform_real_distribution<double>(0.0, 0.999)(random));
            }
            const double value = spline->evaluate(slot, u - glm::dvec3(brick * edge)).value;
            // The cell's own block, and at the brick's lower face the one before it.
            glm::i64vec3 before = cell;
            before[k % 3] = std::max<std::int64_t>(before[k % 3] - 1, 0);
            for (const glm::i64vec3& side : {cell, before}) {
              const glm::i64vec3 b = side / std::int64_t(4);
              const std::size_t number = std::size_t((b.z * bounds.blocks.blocks.y + b.y) * bounds.blocks.blocks.x + b.x);
              ASSERT_LE(bounds.scale.value(bounds.blocks.min[number]), value);
              ASSERT_GE(bounds.scale.value(bounds.blocks.max[number]), value);
              beyond_unrounded += value < unrounded.scale.value(unrounded.blocks.min[number]) || value > unrounded.scale.value(unrounded.blocks.max[number]);
            }
          }
        }
      }
  }
  EXPECT_GT(beyond_unrounded, 100u) << "nothing was put to the test";
}

TEST(BrickErrors, AreThoseOfTheWorstOfABrickAndItsNeighboursHoweverCoefficientsCome) {
  // 7 x 2 x 1 bricks of 4 cells, all coefficients 3 but one of 103 inside brick (2, 0, 0).
  const auto spline = make_spline("trilinear");
  Coefficients<float> c;
  c.lattice = LatticeKind::cartesian;
  c.extents = {29, 9, 5};
  c.apron = spline->apron();
  c.data.assign(std::size_t(c.stride_coset()), 3.0f);
  c.data[c.number(0, {10, 2, 2})] = 103.0f;
  const BrickLayout layout(c.lattice, c.extents, c.apron, 4, Storage::unorm8);
  BrickErrors whole(layout), parts(layout);
  whole.add(c, glm::i64vec3(-c.apron));
  for (std::int64_t x = 0; x < 29; x += 3) {  // slabs of three samples, none the size of a brick
    Coefficients<float> slab = c;
    slab.extents = {3, 9, 5};
    slab.data.assign(std::size_t(slab.stride_coset()), 3.0f);
    if (x == 9) slab.data[slab.number(0, {1, 2, 2})] = 103.0f;
    parts.add(slab, glm::i64vec3(x, 0, 0) - std::int64_t(c.apron));
  }
  const double constant = storage_error(Storage::unorm8, 3.0, 3.0), worst = storage_error(Storage::unorm8, 3.0, 103.0);
  EXPECT_NEAR(worst, 50.0 / 255, 1e-3);
  for (const BrickErrors* errors : {&whole, &parts})
    for (std::int32_t n = 0; n < layout.count(); ++n) {
      const glm::ivec3 brick = layout.brick(n);
      EXPECT_EQ(errors->errors()[std::size_t(n)], brick.x >= 1 && brick.x <= 3 ? worst : constant) << brick.x << ' ' << brick.y;
    }
}

TEST(StreamedBounds, OfStoredBricksAreWiderByHalfAStepOfTheWidestNearAndNoMore) {
  const auto spline = make_spline("trilinear");
  const Volume volume = waves(LatticeKind::cartesian, {200, 9, 9});
  const BrickLayout layout(volume.lattice, volume.extents, spline->apron(), 8, Storage::unorm8);
  const StreamedBounds found = streamed_bounds(VolumeSource(volume), *spline, Spline::Prefilter::none, 8, "volume", {}, {}, &layout);
  const StreamedBounds unrounded = streamed_bounds(VolumeSource(volume), *spline, Spline::Prefilter::none, 8, "volume");
  ASSERT_EQ(found.blocks.min.size(), 25u);
  const double slack = 3.0 * found.scale.step;
  for (std::size_t n = 0; n < 25; ++n) {
    const double wider = unrounded.scale.value(unrounded.blocks.min[n]) - found.scale.value(found.blocks.min[n]);
    EXPECT_GE(wider, -slack);
    EXPECT_LE(wider, 255.0 / 510.0 + slack);
    // Bricks of nothing but 7s, and their neighbours too.
    if (n > 14) {
      EXPECT_LE(wider, slack);
    }
  }
}

/// Notes the largest box that is read.
class WatchedSource final : public SampleSource {
 public:
  explicit WatchedSource(const Volume& volume) : source_(volume) {}
  const Volume& header() const override { return source_.header(); }
  Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const override {
    Volume box = source_.read_box(low, high);
    const std::lock_guard lock(mutex_);
    largest = std::max(largest, box.sample_count());
    return box;
  }
  mutable std::size_t largest = 0;

 private:
  VolumeSource source_;
  mutable std::mutex mutex_;
};

TEST(StreamedBounds, ReadTheSamplesInBoxesOfBoundedSize) {
  const Volume volume{LatticeKind::cartesian, {700, 100, 70}, {}, std::vector<std::uint8_t>(4'900'000), {}};
  const WatchedSource source(volume);
  std::vector<double> fractions;
  streamed_bounds(source, *make_spline("tricubic"), Spline::Prefilter::automatic, 256, "volume",
                  [&](double fraction) { fractions.push_back(fraction); });
  EXPECT_LE(source.largest, std::size_t(521 * 73 * 73));  // 512 x 64 x 64 cells and 2 around, with corners, apron and the prefilter's reach
  EXPECT_GE(fractions.size(), 8u);
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(StreamedBounds, RefuseSamplesThatAreNotFiniteAndBlocksThatAreNone) {
  Volume volume{LatticeKind::bcc, {4, 3, 2}, {}, std::vector<float>(48, 1.0f), {}};
  const auto error = [&](int block) -> std::string {
    try {
      streamed_bounds(VolumeSource(volume), *make_spline("bcc7"), Spline::Prefilter::none, block, "v.nrrd");
    } catch (const InputError& refused) {
      return refused.what();
    }
    return "(no error)";
  };
  EXPECT_EQ(error(2), "(no error)");
  EXPECT_THAT(error(3), HasSubstr("--block: found 3"));
  std::get<std::vector<float>>(volume.samples)[24 + 12 + 4 + 1] = std::numeric_limits<float>::quiet_NaN();
  std::get<std::vector<float>>(volume.samples)[47] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(error(2), "v.nrrd: found 2 NaN or infinite of 48 samples, the first at coset 1, index (1, 1, 1); expected finite samples");
}

TEST(StreamedBounds, LetAnInterruptThroughInBothPasses) {
  const Volume volume = waves(LatticeKind::cartesian, {20, 20, 20});
  for (const double from : {0.0, 0.5})
    EXPECT_THROW(streamed_bounds(VolumeSource(volume), *make_spline("trilinear"), Spline::Prefilter::none, 8, "volume",
                                 [&](double fraction) {
                                   if (fraction >= from) throw Interrupted();
                                 }),
                 Interrupted);
}

}  // namespace
}  // namespace quincunx

#include "accel/void_cells.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "accel/classification.h"

namespace quincunx {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Samples of noise in [0,1], a part of which is NaN or infinite.
Volume holed_noise(LatticeKind lattice, const Extents& n, double part, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  Volume volume;
  volume.lattice = lattice;
  volume.extents = n;
  std::vector<float> samples(volume.sample_count());
  for (float& s : samples) s = uniform(random) < part ? (uniform(random) < 0.5f ? kNan : uniform(random) < 0.5f ? kInf : -kInf) : uniform(random);
  volume.samples = std::move(samples);
  return volume;
}

/// Coefficients without prefilter that are NaN where the sample is not finite, in the border too: what they poison is what has a weight.
Coefficients<double> poisoned(const Spline& spline, const Volume& volume) {
  Volume filled = volume;
  fill_not_finite(filled, 0.0);
  Coefficients<double> c = spline.coefficients(filled, Spline::Prefilter::none);
  const glm::i64vec3 low(-c.apron), high = c.extents + std::int64_t(c.apron);
  for (int coset = 0; coset < coset_count(c.lattice); ++coset)
    for (std::int64_t k = low.z; k < high.z; ++k)
      for (std::int64_t j = low.y; j < high.y; ++j)
        for (std::int64_t i = low.x; i < high.x; ++i)
          if (!std::isfinite(volume.sample(coset, glm::clamp(glm::i64vec3(i, j, k), glm::i64vec3(0), c.extents - std::int64_t(1)))))
            c.data[c.number(coset, {i, j, k})] = kNan;
  return c;
}

/// The definition, by a hundred evaluations in the cell.
bool is_poisoned(const Spline& spline, const Coefficients<double>& c, const glm::i64vec3& cell, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  const glm::dvec3 far(domain_max(c.lattice, c.extents));
  for (int n = 0; n < 100; ++n) {
    const glm::dvec3 u = glm::min(glm::dvec3(cell) + glm::dvec3(uniform(random), uniform(random), uniform(random)), far);
    if (std::isnan(spline.evaluate(c, u).value)) return true;
  }
  return false;
}

TEST(VoidCells, AreThoseInWhichSamplesThatAreNotFiniteHaveAWeight) {
  std::mt19937 random(2);
  for (const std::string_view name : spline_names()) {
    const std::unique_ptr<Spline> spline = make_spline(name);
    for (const Extents& n : {Extents{7, 5, 6}, Extents{11, 2, 3}, Extents{1, 4, 9}, Extents{1, 1, 1}})
      for (const double part : {0.004, 0.05, 0.5, 1.0, 0.0}) {
        const Volume volume = holed_noise(spline->lattice(), n, part, unsigned(100.0 * part) + unsigned(n.x));
        const VoidCells voids = void_cells(*spline, volume);
        const Coefficients<double> c = poisoned(*spline, volume);
        ASSERT_EQ(voids.cells, cell_count(volume.lattice, n));
        EXPECT_EQ(voids.words.empty(), sample_range(volume).not_finite == 0);
        std::uint64_t count = 0, bits = 0;
        for (std::int64_t z = 0; z < voids.cells.z; ++z)
          for (std::int64_t y = 0; y < voids.cells.y; ++y)
            for (std::int64_t x = 0; x < voids.cells.x; ++x) {
              const bool expected = is_poisoned(*spline, c, {x, y, z}, random);
              ASSERT_EQ(voids.at({x, y, z}), expected) << name << ", cell " << x << ' ' << y << ' ' << z;
              count += expected;
            }
        for (const std::uint64_t word : voids.words) bits += std::uint64_t(std::popcount(word));
        EXPECT_EQ(voids.count, count);
        EXPECT_EQ(bits, count) << "none outside the volume";
      }
  }
}

TEST(VoidCells, AreAsManyAboutOneSampleAsItsWeightReaches) {
  // 8 and 64 cells about a point, the outer ones of triquadratic by half; of bcc4, bcc7, bcc8 and bcc12, whose cells 8, 40, 46 and 128 samples reach, with a
  // sample for 4 cells: 32, 160, 184 and 512; of cwlb, whose 16 do: 64.
  for (const auto& [name, expected] : {std::pair{"trilinear", 8u}, {"triquadratic", 64u}, {"tricubic", 64u}, {"catmull-rom", 64u}, {"bcc4", 32u}, {"bcc7", 160u},
                                       {"bcc8", 184u}, {"bcc12", 512u}, {"cwlb", 64u}}) {
    const std::unique_ptr<Spline> spline = make_spline(name);
    Volume volume = holed_noise(spline->lattice(), {9, 9, 9}, 0.0, 1);
    std::get<std::vector<float>>(volume.samples)[4 * 81 + 4 * 9 + 4] = kNan;
    EXPECT_EQ(void_cells(*spline, volume).count, expected) << name;
  }
}

TEST(VoidCells, AreNoneOfIntegersNorWhereSamplesAreFilledOrRefused) {
  const std::unique_ptr<Spline> spline = make_spline("trilinear");
  Volume integers{LatticeKind::cartesian, {2, 2, 2}, {}, std::vector<std::int16_t>(8, 3), {}};
  EXPECT_TRUE(make_finite(integers, *spline, {NanPolicy::Kind::empty, 0.0}).words.empty());
  const Volume holed = holed_noise(LatticeKind::cartesian, {4, 4, 4}, 0.2, 3);
  Volume filled = holed, refused = holed, emptied = holed;
  EXPECT_EQ(make_finite(filled, *spline, {NanPolicy::Kind::fill, 2.0}).count, 0u);
  EXPECT_EQ(sample_range(filled).not_finite, 0u);
  EXPECT_EQ(sample_range(filled).max, 2.0);
  EXPECT_EQ(make_finite(refused, *spline, {}).count, 0u);
  EXPECT_EQ(sample_range(refused).not_finite, sample_range(holed).not_finite);
  EXPECT_EQ(make_finite(emptied, *spline, {NanPolicy::Kind::empty, 0.0}).count, void_cells(*spline, holed).count);
  EXPECT_EQ(sample_range(emptied).not_finite, 0u);
}

/// Whether some cell of the block that is not void touches a range.
bool block_touches(const CellBounds& cells, const VoidCells& voids, const glm::i64vec3& low, int block, std::span<const ValueRange> ranges) {
  const glm::i64vec3 high = glm::min(low + std::int64_t(block), cells.cells);
  for (std::int64_t z = low.z; z < high.z; ++z)
    for (std::int64_t y = low.y; y < high.y; ++y)
      for (std::int64_t x = low.x; x < high.x; ++x) {
        const std::size_t n = cells.number({x, y, z});
        if (voids.at({x, y, z})) continue;
        for (const ValueRange& range : ranges)
          if (cells.value(cells.min[n]) <= range.high && range.low <= cells.value(cells.max[n])) return true;
      }
  return false;
}

TEST(VoidCells, MakeNoBlockAndNoCellActiveWhateverCanBeSeen) {
  constexpr double kAll = std::numeric_limits<double>::max();
  for (const std::string_view name : spline_names()) {
    const std::unique_ptr<Spline> spline = make_spline(name);
    Volume volume = holed_noise(spline->lattice(), {9, 8, 10}, 0.0, 5);
    auto& samples = std::get<std::vector<float>>(volume.samples);
    for (std::size_t n = 0; n < samples.size(); ++n)
      if (n / 9 / 8 % 10 < 5 && n % 9 > 3) samples[n] = n % 2 ? kNan : kInf;
    const VoidCells voids = make_finite(volume, *spline, {NanPolicy::Kind::empty, 0.0});
    const CellBounds all = cell_bounds(*spline, spline->coefficients_float(volume, Spline::Prefilter::automatic));
    CellBounds cells = all;
    leave_out(voids, cells);
    for (const std::vector<ValueRange>& ranges : {std::vector<ValueRange>{{0.4, 0.4}}, {{-kAll, kAll}}, {{-kAll, 0.1}, {0.8, kAll}}, {}}) {
      for (const int block : {1, 2, 8, 32}) {
        const Classification c = classify(block_bounds(cells, block), cells, ranges);
        std::size_t n = 0;
        for (std::int64_t z = 0; z < c.blocks.z; ++z)
          for (std::int64_t y = 0; y < c.blocks.y; ++y)
            for (std::int64_t x = 0; x < c.blocks.x; ++x, ++n)
              ASSERT_EQ(c.level[n] == Classification::active, block_touches(all, voids, std::int64_t(block) * glm::i64vec3(x, y, z), block, ranges))
                  << name << ", block " << block;
      }
      const CellOccupancy exact = occupancy(cells, ranges);
      for (const RangeQueryKind query : {RangeQueryKind::intervals, RangeQueryKind::table, RangeQueryKind::irt}) {
        const CellOccupancy o = occupancy(cells, ranges, query);
        for (std::size_t n = 0; n < o.words.size(); ++n) {
          EXPECT_EQ(o.words[n] & voids.words[n], 0u) << "a void cell is occupied";
          EXPECT_EQ(exact.words[n] & ~o.words[n], 0u) << "a cell is lost";
        }
      }
      std::size_t active = 0;
      for (std::int64_t z = 0; z < cells.cells.z; ++z)
        for (std::int64_t y = 0; y < cells.cells.y; ++y)
          for (std::int64_t x = 0; x < cells.cells.x; ++x) active += block_touches(all, voids, {x, y, z}, 1, ranges);
      EXPECT_EQ(exact.active_cells, active);
    }
  }
}

}  // namespace
}  // namespace quincunx

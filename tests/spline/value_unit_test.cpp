#include "spline/value_unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spline/box_coefficients.h"
#include "spline/spline.h"

namespace quincunx {
namespace {

TEST(ValueUnit, LeavesWhatFloatsHoldAsItIs) {
  EXPECT_TRUE(float_unit(SampleType::float32, 0.0, 255.0).plain());
  EXPECT_TRUE(float_unit(SampleType::float32, -1000.0, 3000.0).plain());
  EXPECT_TRUE(float_unit(SampleType::float32, 0.0, 0.0).plain());
  EXPECT_TRUE(float_unit(SampleType::float32, -1e-9, 1e-12).plain());
  EXPECT_TRUE(float_unit(SampleType::uint16, 65000.0, 65010.0).plain());  // integers of 16 bits are exact
}

TEST(ValueUnit, TakesAnOffsetWhereTheSamplesLieFarFromZero) {
  const ValueUnit unit = float_unit(SampleType::float32, 1e7, 1e7 + 2.0);
  EXPECT_EQ(unit.offset, 1e7 + 1.0);
  EXPECT_EQ(unit.scale, 1.0);
  EXPECT_EQ(unit.number(1e7 + 2.0), 1.0);
  EXPECT_EQ(unit.value(-1.0), 1e7);
  EXPECT_EQ(float_unit(SampleType::float32, 0.7f, 0.7f).number(0.7f), 0.0);  // a constant is nothing but its offset
}

TEST(ValueUnit, ScalesByAPowerOfTwoWhatIsTooLargeOrTooSmall) {
  for (const double size : {1e-45, 1e-38, 1e-20, 1e20, 3.4e38}) {
    const ValueUnit unit = float_unit(SampleType::float32, -size, size);
    EXPECT_EQ(unit.offset, 0.0);
    EXPECT_EQ(unit.scale, std::exp2(std::ilogb(size)));
    EXPECT_GE(unit.number(size), 1.0);
    EXPECT_LT(unit.number(size), 2.0);
    EXPECT_EQ(unit.value(unit.number(0.3 * size)), 0.3 * size);
  }
  // The ends of the whole range of floats do not overflow.
  EXPECT_TRUE(std::isfinite(float_unit(SampleType::float32, -3.4e38, 3.4e38).scale));
}

/// Coefficients in the unit of their samples, as values, and those in double: the largest difference, in parts of the samples' range.
double largest_loss(const Spline& spline, const Volume& volume) {
  const SampleRange range = sample_range(volume);
  const ValueUnit unit = float_unit(volume.type(), range.min, range.max);
  EXPECT_FALSE(unit.plain());
  const auto exact = spline.coefficients(volume, Spline::Prefilter::automatic);
  const auto rounded = spline.coefficients_float(volume, Spline::Prefilter::automatic, unit);
  EXPECT_EQ(rounded.unit, unit);
  double loss = 0.0;
  for (std::size_t n = 0; n < exact.data.size(); ++n) loss = std::max(loss, std::abs(unit.value(rounded.data[n]) - exact.data[n]));
  return loss / (range.max - range.min);
}

Volume noisy(LatticeKind lattice, double offset, double size) {
  Volume volume{lattice, {6, 5, 7}, {}, std::vector<float>{}, {}};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<float> samples(std::size_t(coset_count(lattice)) * 6 * 5 * 7);
  for (float& s : samples) s = float(offset + size * uniform(random));
  volume.samples = samples;
  return volume;
}

TEST(ValueUnit, KeepsCoefficientsToAFloatOfTheirRangeWhateverTheirOffsetAndSize) {
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    for (const auto& [offset, size] : {std::pair{1e7, 30.0}, {-1e6, 2.0}, {0.0, 1e-40}, {0.0, 3e38}, {1e30, 1e24}})
      EXPECT_LT(largest_loss(*spline, noisy(spline->lattice(), offset, size)), 0x1p-21) << name << " " << offset << " " << size;
  }
}

TEST(ValueUnit, IsTheSameForABoxCutOutOfTheVolume) {
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    const Volume volume = noisy(spline->lattice(), 1e7, 50.0);
    const ValueUnit unit{1e7 + 25.0, 1.0};
    const auto whole = spline->coefficients_float(volume, Spline::Prefilter::automatic, unit);
    const IndexBox box{{1, -2, 3}, {4, 6, 5}};
    std::vector<float> expected(std::size_t(coset_count(volume.lattice)) * 4 * 6 * 5), found(expected.size());
    copy_box(whole, box, expected);
    box_coefficients(VolumeSource(volume), *spline, Spline::Prefilter::automatic, unit, box, found);
    EXPECT_EQ(found, expected) << name;
  }
}

}  // namespace
}  // namespace quincunx

#include "spline/storage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spline/spline.h"

namespace quincunx {
namespace {

constexpr Storage kPacked[] = {Storage::float16, Storage::unorm16, Storage::unorm8};

/// All numbers of a format, ascending.
std::vector<double> all_numbers(Storage storage) {
  std::vector<double> numbers;
  const int codes = storage == Storage::unorm8 ? 256 : 65536;
  for (int n = 0; n < codes; ++n) {
    const bool infinite_or_nan = storage == Storage::float16 && (n & 0x7c00) == 0x7c00, subnormal = storage == Storage::float16 && (n & 0x7c00) == 0 && (n & 1023);
    if (!infinite_or_nan && !subnormal) numbers.push_back(stored_number(storage, std::uint16_t(n)));
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// A 16-bit float as IEEE 754 says what it means.
double meaning(std::uint16_t bits) {
  const double size = std::exp2((bits >> 10 & 31) - 15) * (1.0 + (bits & 1023) / 1024.0);
  return (bits >> 15 ? -1.0 : 1.0) * ((bits & 0x7fff) == 0 ? 0.0 : size);
}

Coefficients<float> coefficients_of(std::vector<float> numbers) {
  Coefficients<float> c;
  c.lattice = LatticeKind::cartesian;
  c.extents = {std::int64_t(numbers.size()), 1, 1};
  c.data = std::move(numbers);
  return c;
}

TEST(Storage, KeepsEachOfItsOwnNumbers) {
  for (const Storage storage : kPacked)
    for (const double number : all_numbers(storage)) ASSERT_EQ(double(stored_number(storage, storage_bits(storage, number))), number) << storage_name(storage);
  for (int n = 0; n < 65536; ++n) {
    if ((n & 0x7c00) == 0x7c00 || ((n & 0x7c00) == 0 && (n & 1023))) continue;
    ASSERT_EQ(double(stored_number(Storage::float16, std::uint16_t(n))), meaning(std::uint16_t(n))) << n;
  }
  EXPECT_EQ(stored_number(Storage::unorm16, 65535), 1.0f);
  EXPECT_EQ(stored_number(Storage::unorm8, 51), 0.2f);
}

TEST(Storage, RoundsToTheNearestNumber) {
  std::mt19937 random(1);
  for (const Storage storage : kPacked) {
    const std::vector<double> numbers = all_numbers(storage);
    for (int n = 0; n < 20'000; ++n) {
      const std::size_t k = random() % (numbers.size() - 1);
      const double number = std::lerp(numbers[k], numbers[k + 1], double(random()) / 4294967296.0);
      const double found = stored_number(storage, storage_bits(storage, number));
      const double nearest = std::min(number - numbers[k], numbers[k + 1] - number);
      ASSERT_LE(std::abs(found - number), nearest + 1e-7 * std::abs(number)) << storage_name(storage) << ": " << number;
    }
  }
  // Half way between two 16-bit floats: to the one whose last bit is 0.
  EXPECT_EQ(storage_bits(Storage::float16, 1.0 + 0x1p-11), 0x3c00);
  EXPECT_EQ(storage_bits(Storage::float16, 1.0 + 0x3p-11), 0x3c02);
  EXPECT_EQ(storage_bits(Storage::float16, 2.0 - 0x1p-12), 0x4000) << "a carry into the exponent";
}

TEST(Storage, TakesTheEndForWhatIsBeyondIt) {
  EXPECT_EQ(storage_bits(Storage::unorm8, -0.1), 0);
  EXPECT_EQ(storage_bits(Storage::unorm8, 1.1), 255);
  EXPECT_EQ(storage_bits(Storage::unorm16, 1e9), 65535);
  EXPECT_EQ(stored_number(Storage::float16, storage_bits(Storage::float16, 65519.0)), 65504.0f);
  EXPECT_EQ(stored_number(Storage::float16, storage_bits(Storage::float16, -1e300)), -65504.0f);
}

TEST(Storage, HasNoSubnormalHalves) {
  EXPECT_EQ(stored_number(Storage::float16, storage_bits(Storage::float16, 0x0.9p-14)), 0x1p-14f);
  EXPECT_EQ(stored_number(Storage::float16, storage_bits(Storage::float16, -0x0.7p-14)), 0.0f);
}

TEST(Storage, HoldsCoefficientsToHalfAStepOfTheirRangeWhateverItIs) {
  std::mt19937 random(2);
  for (const Storage storage : kPacked)
    for (const auto& [low, high] : {std::pair{0.0, 255.0}, {-1.0, 1e-3}, {1e6, 1e6 + 8.0}, {-3e20, 5e20}, {-2e-20, 1e-20}}) {
      std::vector<float> numbers{float(low), float(high)};
      for (int n = 0; n < 5000; ++n) numbers.push_back(float(std::lerp(low, high, double(random()) / 4294967296.0)));
      Coefficients<float> c = coefficients_of(numbers);
      c.unit = {100.0, 0.5};
      const ValueUnit before = c.unit, unit = storage_unit(storage, numbers[0], numbers[1]);
      const std::vector<std::byte> packed = store(storage, c);
      ASSERT_EQ(packed.size(), numbers.size() * storage_bytes(storage));
      const double bound = storage_error(storage, numbers[0], numbers[1]);
      const double step = (numbers[1] - numbers[0]) * (storage == Storage::float16 ? 0x1p-11 : storage == Storage::unorm16 ? 1 / 65535.0 : 1 / 255.0);
      EXPECT_LE(bound, 0.5001 * step + 2e-6 * std::max(std::abs(low), std::abs(high))) << storage_name(storage);
      const Coefficients<double> values = values_of(c);
      for (std::size_t n = 0; n < numbers.size(); ++n) {
        ASSERT_LE(std::abs(values.data[n] - before.value(numbers[n])), before.scale * bound * (1.0 + 1e-12)) << storage_name(storage) << ": " << numbers[n];
        // As a kernel decodes in floats.
        const float product = float(unit.scale) * c.data[n], decoded = float(unit.offset) + product;
        ASSERT_LE(std::abs(double(decoded) - double(numbers[n])), bound);
      }
      for (const std::size_t end : {0, 1})
        EXPECT_NEAR(values.data[end], before.value(numbers[end]), 1e-6 * (high - low) + 1e-7 * std::abs(high)) << "the ends are numbers of the format";
    }
}

TEST(Storage, HoldsAConstantAndAVolumeOfOneValueAsTheyAre) {
  for (const Storage storage : kPacked)
    for (const std::vector<float>& numbers : {std::vector<float>(7, 0.1f), std::vector<float>{-3.7e7f}, std::vector<float>(3, 0.0f)}) {
      Coefficients<float> c = coefficients_of(numbers);
      store(storage, c);
      for (std::size_t n = 0; n < numbers.size(); ++n) EXPECT_EQ(values_of(c).data[n], double(numbers[n])) << storage_name(storage);
      EXPECT_GT(c.unit.scale, 0.0);
    }
}

TEST(Storage, OfFloatsChangesNothing) {
  Coefficients<float> c = coefficients_of({1.0f, 0.1f, -3.0f});
  const std::vector<float> before = c.data;
  EXPECT_TRUE(store(Storage::float32, c).empty());
  EXPECT_EQ(c.data, before);
  EXPECT_TRUE(c.unit.plain());
  EXPECT_EQ(storage_error(Storage::float32, -1.0, 1.0), 0.0);
}

TEST(Storage, IsTheSameInASecondRun) {
  // 8 bits of a volume's prefiltered coefficients: what is stored is what the device gets, number by number.
  std::mt19937 random(3);
  Volume volume{LatticeKind::bcc, {5, 4, 3}, {}, std::vector<std::uint8_t>(120), {}};
  for (auto& sample : std::get<std::vector<std::uint8_t>>(volume.samples)) sample = std::uint8_t(random());
  const auto spline = make_spline("bcc7");
  for (const Storage storage : kPacked) {
    Coefficients<float> c = spline->coefficients_float(volume, Spline::Prefilter::automatic);
    const std::vector<std::byte> packed = store(storage, c);
    Coefficients<float> again = c;
    again.unit = {};
    // Of a unit's numbers the ends are the format's own, so that storing them once more changes nothing but the unit.
    EXPECT_EQ(store(storage, again), packed) << storage_name(storage);
  }
}

}  // namespace
}  // namespace quincunx

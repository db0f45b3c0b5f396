#include "lattice/volume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lattice/error.h"
#include "lattice/memory.h"

namespace quincunx {
namespace {

template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(Volume, SamplesLieXFastestAndTheCosetSlowest) {
  Volume volume{LatticeKind::bcc, {2, 3, 4}, {}, std::vector<std::uint16_t>(48), {}};
  auto& samples = std::get<std::vector<std::uint16_t>>(volume.samples);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = std::uint16_t(n);
  EXPECT_EQ(volume.sample_count(), 48u);
  EXPECT_EQ(volume.sample(0, {0, 0, 0}), 0.0);
  EXPECT_EQ(volume.sample(0, {1, 0, 0}), 1.0);
  EXPECT_EQ(volume.sample(0, {0, 1, 0}), 2.0);
  EXPECT_EQ(volume.sample(0, {0, 0, 1}), 6.0);
  EXPECT_EQ(volume.sample(1, {0, 0, 0}), 24.0);
  EXPECT_EQ(volume.sample(1, {1, 2, 3}), 47.0);
}

TEST(Volume, TheTypeIsThatOfTheSamples) {
  Volume volume;
  volume.samples = std::vector<std::uint8_t>(1, 255);
  EXPECT_EQ(sample_type_name(volume.type()), "uint8");
  EXPECT_EQ(sample_type_bytes(volume.type()), 1u);
  volume.samples = std::vector<std::int16_t>{-32768};
  EXPECT_EQ(sample_type_name(volume.type()), "int16");
  EXPECT_EQ(sample_type_bytes(volume.type()), 2u);
  volume.samples = std::vector<std::uint16_t>{65535};
  EXPECT_EQ(sample_type_name(volume.type()), "uint16");
  EXPECT_EQ(sample_type_bytes(volume.type()), 2u);
  volume.samples = std::vector<float>{0.5f};
  EXPECT_EQ(sample_type_name(volume.type()), "float32");
  EXPECT_EQ(sample_type_bytes(volume.type()), 4u);
}

TEST(Volume, AVolumeWithFewerOrMoreSamplesThanItsExtentsSayIsRefused) {
  Volume volume{LatticeKind::bcc, {2, 2, 2}, {}, std::vector<float>(16), {}};
  EXPECT_NO_THROW(check_volume(volume, "v"));
  volume.samples = std::vector<float>(8);  // one coset short
  EXPECT_THAT(message_of([&] { check_volume(volume, "v.nrrd"); }),
              testing::AllOf(testing::HasSubstr("v.nrrd"), testing::HasSubstr("8 samples, expected 16")));
  volume.samples = std::vector<float>(17);
  EXPECT_THROW(check_volume(volume, "v"), InputError);
}

TEST(Volume, ExtentsBelowOneAreRefused) {
  for (const Extents extents : {Extents(0, 2, 2), Extents(2, 0, 2), Extents(2, 2, 0), Extents(-1, -1, 2)}) {
    Volume volume{LatticeKind::cartesian, extents, {}, std::vector<float>(2), {}};
    EXPECT_THROW(check_volume(volume, "v"), InputError);
  }
}

TEST(Volume, ExtentsWhoseProductOverflowsAreRefused) {
  // (2^40)^3 wraps to 0 in 64 bits, and 2^62 * 2 * 2 does as well: both would look like empty volumes.
  const std::int64_t huge = std::int64_t(1) << 40, top = std::int64_t(1) << 62;
  for (const Extents extents : {Extents(huge, huge, huge), Extents(top, 2, 2)}) {
    EXPECT_THAT(message_of([&] { checked_sample_count(LatticeKind::cartesian, extents, SampleType::uint8, "--dims"); }),
                testing::HasSubstr("--dims"));
  }
  EXPECT_EQ(checked_sample_count(LatticeKind::bcc, {huge, 2, 3}, SampleType::float32, "v"), 12ull << 40);
}

TEST(Volume, MoreThanTheMachinesMemoryIsRefusedBeforeItIsAllocated) {
  EXPECT_NO_THROW(check_fits_memory(1 << 20, "v"));
  EXPECT_THAT(message_of([] { check_fits_memory(std::uint64_t(1) << 60, "v.nrrd"); }),
              testing::AllOf(testing::HasSubstr("v.nrrd"), testing::HasSubstr("memory")));
}

}  // namespace
}  // namespace quincunx

#include <numeric>

#include "tests/gpu/test_device.h"

namespace quincunx::gpu {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;

template <class Function>
std::string device_error_of(Function&& function) {
  try {
    function();
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "";
}

// Mapped, as on a CPU device, and staged, as on a discrete GPU.
class BufferTest : public GpuTest, public ::testing::WithParamInterface<Transfer> {
 protected:
  void SetUp() override { open(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(BothWays, BufferTest, ::testing::Values(Transfer::automatic, Transfer::staged),
                         [](const auto& way) { return way.param == Transfer::staged ? "Staged" : "Automatic"; });

TEST_P(BufferTest, StartsWithZerosAlsoInMemoryUsedBefore) {
  for (int round = 0; round < 3; ++round) {
    // 4,099 is no multiple of four: the last bytes count as well.
    const Buffer buffer = create_buffer(*device, 4099, BufferUse::storage, "zeros");
    EXPECT_THAT(contents<std::uint8_t>(buffer), Each(0));
    upload(*device, buffer, bytes_of(std::vector<std::uint8_t>(4099, 0xff)));
  }
}

TEST_P(BufferTest, GivesBackWhatWasUploadedAtAnyOffset) {
  std::vector<std::uint8_t> expected(10007);
  std::iota(expected.begin(), expected.end(), std::uint8_t{0});
  const Buffer buffer = filled(expected);
  const std::vector<std::uint8_t> patch = {250, 251, 252};
  upload(*device, buffer, bytes_of(patch), 5001);
  std::copy(patch.begin(), patch.end(), expected.begin() + 5001);
  EXPECT_EQ(contents<std::uint8_t>(buffer), expected);
  std::vector<std::uint8_t> part(7);
  download(*device, buffer, std::as_writable_bytes(std::span(part)), 4999);
  EXPECT_EQ(part, std::vector<std::uint8_t>(expected.begin() + 4999, expected.begin() + 5006));
}

TEST_P(BufferTest, LargerThanTheStagingBufferComesBackWhole) {
  std::vector<std::uint32_t> expected((70u << 20) / 4 + 1);  // 70 MiB: three copies
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<std::uint32_t>(i * 2654435761u);
  const Buffer buffer = filled(expected);
  EXPECT_TRUE(contents<std::uint32_t>(buffer) == expected);
}

TEST_P(BufferTest, RefusesBytesOutsideIt) {
  const Buffer buffer = create_buffer(*device, 16, BufferUse::storage, "small");
  std::vector<std::uint8_t> bytes(9);
  EXPECT_NO_THROW(upload(*device, buffer, bytes_of(bytes), 7));
  EXPECT_THROW(upload(*device, buffer, bytes_of(bytes), 8), std::out_of_range);
  EXPECT_THROW(upload(*device, buffer, bytes_of(bytes), UINT64_MAX - 3), std::out_of_range);
  EXPECT_THROW(download(*device, buffer, std::as_writable_bytes(std::span(bytes)), 8), std::out_of_range);
}

TEST_P(BufferTest, OfNoBytesHasFour) {
  const Buffer buffer = create_buffer(*device, 0, BufferUse::storage, "nothing");
  EXPECT_EQ(buffer.bytes, 4u);
  EXPECT_THAT(contents<std::uint32_t>(buffer), ::testing::ElementsAre(0u));
}

TEST_F(GpuTest, BuffersOverALimitAreRefusedByNameAndSize) {
  open();
  const std::uint64_t storage = info(*device).max_storage_buffer_range;
  EXPECT_THAT(
      device_error_of([&] { create_buffer(*device, storage + 1, BufferUse::storage, "the coefficients"); }),
      AllOf(HasSubstr("the coefficients"), HasSubstr(std::to_string(storage + 1)), HasSubstr(std::to_string(storage))));
  const std::uint64_t texels = info(*device).max_texel_buffer_elements;
  EXPECT_THAT(device_error_of(
                  [&] { create_buffer(*device, 4 * (texels + 1), BufferUse::texel, "texels", VK_FORMAT_R32_SFLOAT); }),
              AllOf(HasSubstr("texels"), HasSubstr(std::to_string(texels + 1))));
  EXPECT_THAT(device_error_of([&] { create_buffer(*device, 1u << 31, BufferUse::uniform, "parameters"); }),
              HasSubstr("parameters"));
  for (const std::uint64_t absurd : {std::uint64_t{1} << 50, UINT64_MAX}) {
    EXPECT_THAT(device_error_of([&] { create_buffer(*device, absurd, BufferUse::address, "absurd"); }),
                AllOf(HasSubstr("absurd"), HasSubstr(std::to_string(absurd))));
  }
}

TEST_F(GpuTest, TexelBuffersNeedAFormatTheDeviceReads) {
  open();
  EXPECT_THROW(create_buffer(*device, 16, BufferUse::texel, "formless"), std::runtime_error);
  EXPECT_THAT(
      device_error_of([&] { create_buffer(*device, 16, BufferUse::texel, "depths", VK_FORMAT_D24_UNORM_S8_UINT); }),
      AllOf(HasSubstr("depths"), HasSubstr("D24UnormS8Uint")));
  EXPECT_NE(create_buffer(*device, 16, BufferUse::texel, "floats", VK_FORMAT_R32_SFLOAT).view,
            VkBufferView{VK_NULL_HANDLE});
}

TEST_F(GpuTest, AddressedBuffersMayPassTheStorageLimit) {
  open();
  const std::uint64_t storage = info(*device).max_storage_buffer_range;
  if (!features(*device).buffer_address || storage > (1u << 28)) GTEST_SKIP() << "no addresses, or no such limit";
  const Buffer buffer = create_buffer(*device, storage + 64, BufferUse::address, "large");
  EXPECT_NE(buffer.address, 0u);
  const std::vector<std::uint32_t> last = {1, 2, 3, 4};
  upload(*device, buffer, bytes_of(last), buffer.bytes - 16);
  std::vector<std::uint32_t> found(4);
  download(*device, buffer, std::as_writable_bytes(std::span(found)), buffer.bytes - 16);
  EXPECT_EQ(found, last);
}

}  // namespace
}  // namespace quincunx::gpu

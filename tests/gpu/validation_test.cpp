#include "gpu/device_state.h"
#include "tests/gpu/test_device.h"

namespace quincunx::gpu {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Not the GpuTest's own check of silence: these make mistakes on purpose.
std::shared_ptr<Device> open_validated(const TemporaryFolder& folder) {
  DeviceConfig config;
  config.validation = config.gpu_assisted = true;
  config.cache_folder = folder.path.string();
  return open_device(config);
}

TEST(Validation, MessagesOfAMistakeAreSeen) {
  const TemporaryFolder folder;
  const auto device = open_validated(folder);
  EXPECT_THAT(validation_messages(*device), IsEmpty());
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;  // and a size of 0, which Vulkan forbids
  VkBuffer buffer = VK_NULL_HANDLE;
  vkCreateBuffer(device->handle, &info, nullptr, &buffer);
  vkDestroyBuffer(device->handle, buffer, nullptr);
  EXPECT_THAT(validation_messages(*device), Contains(HasSubstr("VUID-VkBufferCreateInfo-size-00912")));
}

TEST(Validation, MissingBarriersAreSeen) {
  const TemporaryFolder folder;
  const auto device = open_validated(folder);
  const Buffer buffer = create_buffer(*device, 64, BufferUse::storage, "written twice");
  run_commands(*device, [&](VkCommandBuffer commands) {
    vkCmdFillBuffer(commands, buffer.handle, 0, 64, 1);
    vkCmdFillBuffer(commands, buffer.handle, 0, 64, 2);  // without a barrier before
  });
  EXPECT_THAT(validation_messages(*device), Contains(::testing::ContainsRegex("SYNC-HAZARD-WRITE.AFTER.WRITE")));
}

TEST(Validation, AKernelThatWritesBeyondABufferIsSeenWhereTheLayerCanInstrumentIt) {
  const TemporaryFolder folder;
  const auto device = open_validated(folder);
  const Files files{{{"k.comp",
                      "#version 460\nlayout(local_size_x = 1) in;\nlayout(binding = 0) buffer O { uint count; uint v[]; } r;\n"
                      "void main() { r.v[r.count + 1000u] = 7u; }\n"}}};
  const Pipeline pipeline = create_pipeline(*device, compile(*device, files.lookup(), {"k.comp", {}}));
  dispatch(*device, pipeline, {{"r", create_buffer(*device, 64, BufferUse::storage, "small")}}, {}, 1);
  EXPECT_THAT(validation_messages(*device), Contains(HasSubstr("out of bounds")));
}

TEST(Validation, ObjectsNeverDestroyedAreToldOnClosing) {
  const TemporaryFolder folder;
  auto device = open_validated(folder);
  VkFenceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreateFence(device->handle, &info, nullptr, &fence), VK_SUCCESS);
  ::testing::internal::CaptureStderr();
  device.reset();
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("on closing the device"));
}

TEST(Validation, AllThatWasMadeIsDestroyed) {
  const TemporaryFolder folder;
  auto device = open_validated(folder);
  {
    const Files files{{{"k.comp",
                        "#version 460\nlayout(local_size_x = 1) in;\nlayout(binding = 0) buffer O { uint v[]; } r;\n"
                        "void main() { r.v[0] = 1; }\n"}}};
    const Pipeline pipeline = create_pipeline(*device, compile(*device, files.lookup(), {"k.comp", {}}));
    const Buffer storage = create_buffer(*device, 64, BufferUse::storage, "storage");
    const Buffer texel = create_buffer(*device, 64, BufferUse::texel, "texel", VK_FORMAT_R8_UNORM);
    dispatch(*device, pipeline, {{"r", storage}}, {}, 1);
    EXPECT_THROW(create_buffer(*device, std::uint64_t{1} << 60, BufferUse::texel, "too large", VK_FORMAT_R32_SFLOAT),
                 DeviceError);
  }
  EXPECT_THAT(validation_messages(*device), IsEmpty());
  ::testing::internal::CaptureStderr();
  device.reset();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Validation, IsOffUnlessAskedFor) {
  const TemporaryFolder folder;
  DeviceConfig config;
  config.cache_folder = folder.path.string();
  const auto device = open_device(config);
  EXPECT_EQ(device->instance->messenger, VkDebugUtilsMessengerEXT{VK_NULL_HANDLE});
  EXPECT_THAT(validation_messages(*device), IsEmpty());
}

}  // namespace
}  // namespace quincunx::gpu

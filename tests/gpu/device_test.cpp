#include "tests/gpu/test_device.h"

namespace quincunx::gpu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

DeviceInfo made_up(std::uint32_t index, const std::string& name, const std::string& type, bool usable = true) {
  DeviceInfo info;
  info.index = index;
  info.name = name;
  info.type = type;
  info.usable = usable;
  return info;
}

const std::vector<DeviceInfo> kDevices = {
    made_up(0, "llvmpipe (LLVM 15)", "CPU"),     made_up(1, "Virtio-GPU Venus", "virtual GPU"),
    made_up(2, "Radeon 780M", "integrated GPU"), made_up(3, "GeForce 210", "discrete GPU", false),
    made_up(4, "NVIDIA H200", "discrete GPU"),   made_up(5, "NVIDIA H200 second", "discrete GPU"),
};

std::string selection_error(std::span<const DeviceInfo> devices, const std::string& select) {
  try {
    choose_device(devices, select);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "";
}

TEST(DeviceChoice, PrefersDiscreteThenIntegratedThenVirtualThenCpu) {
  std::vector<DeviceInfo> devices = kDevices;
  std::vector<std::string> order;
  while (!devices.empty() && selection_error(devices, "").empty()) {
    const std::uint32_t chosen = choose_device(devices, "");
    order.push_back(devices[chosen].name);
    devices.erase(devices.begin() + chosen);
  }
  EXPECT_THAT(order, ::testing::ElementsAre("NVIDIA H200", "NVIDIA H200 second", "Radeon 780M", "Virtio-GPU Venus",
                                            "llvmpipe (LLVM 15)"));
}

TEST(DeviceChoice, TakesAnIndexOrAPartOfTheNameInAnyCase) {
  EXPECT_EQ(choose_device(kDevices, "1"), 1u);
  EXPECT_EQ(choose_device(kDevices, "LLVMPIPE"), 0u);
  EXPECT_EQ(choose_device(kDevices, "second"), 5u);
  EXPECT_EQ(choose_device(kDevices, "nvidia"), 4u);
}

TEST(DeviceChoice, IndexIsThatOfTheListAlsoWhereTheListIsAPart) {
  EXPECT_EQ(choose_device(std::span(kDevices).subspan(4), "5"), 1u);
}

TEST(DeviceChoice, ErrorsListTheDevices) {
  EXPECT_THAT(selection_error(kDevices, "6"),
              AllOf(HasSubstr("index 6"), HasSubstr("0: llvmpipe"), HasSubstr("4: NVIDIA H200 (discrete")));
  EXPECT_THAT(selection_error(kDevices, "99999999999999999999"), HasSubstr("no device of index 99999999999999999999"));
  EXPECT_THAT(selection_error(kDevices, "voodoo"), AllOf(HasSubstr("'voodoo'"), HasSubstr("2: Radeon 780M (integrated GPU)")));
  EXPECT_THAT(selection_error(kDevices, "3"), AllOf(HasSubstr("GeForce 210"), HasSubstr("lacks Vulkan 1.2")));
  EXPECT_THAT(selection_error({}, ""), HasSubstr("mesa-vulkan-drivers"));
}

TEST(Devices, ListedOnesAreNamedAndOneIsUsable) {
  const std::vector<DeviceInfo> devices = list_devices();
  ASSERT_THAT(devices, Not(IsEmpty()));
  EXPECT_TRUE(std::any_of(devices.begin(), devices.end(), [](const DeviceInfo& device) { return device.usable; }));
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, i);
    EXPECT_THAT(devices[i].name, Not(IsEmpty()));
    EXPECT_THAT(devices[i].driver, Not(IsEmpty()));
    EXPECT_GE(devices[i].max_storage_buffer_range, 1u << 27);  // Vulkan's least
    EXPECT_GT(devices[i].memory_bytes, 0u);
  }
}

TEST(Devices, OpenedByIndexAndByNameAreTheListedOnes) {
  const std::vector<DeviceInfo> devices = list_devices();
  ASSERT_THAT(devices, Not(IsEmpty()));
  for (const std::string& select : {std::to_string(devices[0].index), devices[0].name}) {
    DeviceConfig config;
    config.select = select;
    const auto device = open_device(config);
    EXPECT_EQ(info(*device).name, devices[0].name);
    EXPECT_EQ(info(*device).index, devices[0].index);
  }
}

TEST(Devices, OneThatIsNotThereIsAnErrorThatListsThose) {
  DeviceConfig config;
  config.select = "no such device";
  try {
    open_device(config);
    FAIL() << "it was opened";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no such device"), HasSubstr("0: " + list_devices().at(0).name)));
  }
}

TEST_F(GpuTest, RobustAccessIsOnWithValidationAlone) {
  open();
  EXPECT_TRUE(features(*device).robust_access);
  DeviceConfig plain = config();
  plain.validation = false;
  EXPECT_FALSE(features(*open_device(plain)).robust_access);
}

TEST_F(GpuTest, DevicesAreIndependentOfEachOther) {
  open();
  const auto second = open_device(config());
  const Buffer mine = create_buffer(*device, 16, BufferUse::storage, "mine");
  EXPECT_NE(device, second);
  EXPECT_THAT(validation_messages(*second), IsEmpty());
}

TEST_F(GpuTest, BuffersKeepTheirDeviceAlive) {
  open();
  Buffer buffer = filled(std::vector<float>{1.0f, 2.0f});
  const std::weak_ptr<Device> watch = device;
  device.reset();
  EXPECT_FALSE(watch.expired());
  buffer = {};
  EXPECT_TRUE(watch.expired());
}

}  // namespace
}  // namespace quincunx::gpu

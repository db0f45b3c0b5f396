#include "gpu/device_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>

#include "gpu/error.h"
#include "gpu/instance.h"

namespace quincunx::gpu {
namespace {

// From the best to the worst, as choose_device prefers them.
constexpr std::array<const char*, 5> kTypes = {"discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"};

std::size_t rank(const DeviceInfo& device) {
  return static_cast<std::size_t>(std::find(kTypes.begin(), kTypes.end(), device.type) - kTypes.begin());
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string list_text(std::span<const DeviceInfo> devices) {
  if (devices.empty()) return "there is no Vulkan device; Debian's mesa-vulkan-drivers brings one that runs on the CPU";
  std::string text = "the devices are";
  for (const DeviceInfo& device : devices) {
    text += fmt::format("{} {}: {} ({}{})", device.index == devices[0].index ? "" : ",", device.index, device.name,
                        device.type, device.usable ? "" : ", not usable");
  }
  return text;
}

bool matches(const DeviceInfo& device, const std::string& select) {
  return select.empty() || lower(device.name).find(lower(select)) != std::string::npos;
}

bool is_index(const std::string& select) {
  return !select.empty() && std::all_of(select.begin(), select.end(), [](unsigned char c) { return std::isdigit(c); });
}

std::optional<std::uint32_t> parse_index(const std::string& select) {
  std::uint32_t index = 0;
  const auto result = std::from_chars(select.data(), select.data() + select.size(), index);
  return result.ec == std::errc() ? std::optional(index) : std::nullopt;
}

const DeviceInfo& require_usable(const DeviceInfo& device, std::span<const DeviceInfo> devices) {
  if (device.usable) return device;
  throw DeviceError(fmt::format("device {} ({}) lacks Vulkan 1.2, a compute queue or timestamps; {}", device.index,
                                device.name, list_text(devices)));
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
  const std::unique_ptr<Instance> instance = create_instance(Validation::off);
  std::vector<DeviceInfo> devices;
  if (!instance) return devices;
  for (VkPhysicalDevice physical : physical_devices(*instance)) {
    devices.push_back(describe(physical, static_cast<std::uint32_t>(devices.size())));
  }
  return devices;
}

std::uint32_t choose_device(std::span<const DeviceInfo> devices, const std::string& select) {
  if (is_index(select)) {
    const std::optional<std::uint32_t> index = parse_index(select);
    for (std::size_t i = 0; i < devices.size(); ++i) {
      if (index && devices[i].index == *index)
        return require_usable(devices[i], devices), static_cast<std::uint32_t>(i);
    }
    throw DeviceError(fmt::format("there is no device of index {}; {}", select, list_text(devices)));
  }
  const DeviceInfo* best = nullptr;
  const auto better = [](const DeviceInfo& a, const DeviceInfo& b) {
    return a.usable != b.usable ? a.usable : rank(a) < rank(b);
  };
  for (const DeviceInfo& device : devices) {
    if (matches(device, select) && (!best || better(device, *best))) best = &device;
  }
  if (!best && select.empty()) throw DeviceError("no device to run on: " + list_text(devices));
  if (!best) throw DeviceError(fmt::format("no device has '{}' in its name; {}", select, list_text(devices)));
  return static_cast<std::uint32_t>(&require_usable(*best, devices) - devices.data());
}

}  // namespace quincunx::gpu

#include "gpu/pipeline_cache.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "gpu/check.h"
#include "gpu/device_state.h"
#include "gpu/disk_cache.h"

namespace quincunx::gpu {
namespace {

std::string cache_name(const Device& device) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device.physical, &properties);
  std::string uuid;
  for (std::uint8_t byte : properties.pipelineCacheUUID) uuid += fmt::format("{:02x}", byte);
  return fmt::format("{}-{:08x}.pipelines", uuid, properties.driverVersion);
}

}  // namespace

void load_pipeline_cache(Device& device) {
  device.pipeline_cache_name = cache_name(device);
  const auto content = read_cached(device.cache_folder, device.pipeline_cache_name).value_or(std::vector<std::byte>());
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = content.size();
  info.pInitialData = content.data();
  QUINCUNX_VK(vkCreatePipelineCache(device.handle, &info, nullptr, &device.pipeline_cache));
  // The size as the driver now gives it, not the file's: a driver that refused the file starts from nothing.
  QUINCUNX_VK(vkGetPipelineCacheData(device.handle, device.pipeline_cache, &device.pipeline_cache_bytes, nullptr));
}

void save_pipeline_cache(Device& device) noexcept try {
  if (!device.pipeline_cache || device.cache_folder.empty()) return;
  std::size_t bytes = 0;
  QUINCUNX_VK(vkGetPipelineCacheData(device.handle, device.pipeline_cache, &bytes, nullptr));
  if (bytes <= device.pipeline_cache_bytes) return;
  std::vector<std::byte> content(bytes);
  QUINCUNX_VK(vkGetPipelineCacheData(device.handle, device.pipeline_cache, &bytes, content.data()));
  content.resize(bytes);
  write_cached(device.cache_folder, device.pipeline_cache_name, content);
} catch (...) {
  // A cache that cannot be kept is only a slower start.
}

}  // namespace quincunx::gpu

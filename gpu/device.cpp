#include "gpu/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "gpu/check.h"
#include "gpu/device_state.h"
#include "gpu/disk_cache.h"
#include "gpu/pipeline_cache.h"

namespace quincunx::gpu {
namespace {

// The chain of feature structs that is asked of the physical device and, pruned, given to vkCreateDevice.
struct FeatureChain {
  VkPhysicalDeviceVulkan12Features v12{};
  VkPhysicalDeviceFeatures2 core{};
  FeatureChain() {
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    core.pNext = &v12;
  }
  FeatureChain(const FeatureChain&) = delete;
  FeatureChain& operator=(const FeatureChain&) = delete;
};

void choose_features(Device& device, FeatureChain& wanted, bool validation) {
  FeatureChain has;
  vkGetPhysicalDeviceFeatures2(device.physical, &has.core);
  wanted.core.features.shaderFloat64 = has.core.features.shaderFloat64;
  wanted.core.features.shaderInt64 = has.core.features.shaderInt64;
  wanted.core.features.robustBufferAccess = validation && has.core.features.robustBufferAccess;
  wanted.v12.shaderInt8 = has.v12.shaderInt8;
  wanted.v12.storageBuffer8BitAccess = has.v12.storageBuffer8BitAccess;
  wanted.v12.bufferDeviceAddress = has.v12.bufferDeviceAddress;
  wanted.v12.scalarBlockLayout = has.v12.scalarBlockLayout;

  device.features.float64 = wanted.core.features.shaderFloat64;
  device.features.int64 = wanted.core.features.shaderInt64;
  device.features.robust_access = wanted.core.features.robustBufferAccess;
  device.features.int8 = wanted.v12.shaderInt8;
  device.features.storage8 = wanted.v12.storageBuffer8BitAccess;
  device.features.buffer_address = wanted.v12.bufferDeviceAddress;
  device.features.scalar_layout = wanted.v12.scalarBlockLayout;
}

void choose_physical(Device& device, const DeviceConfig& config) {
  std::vector<VkPhysicalDevice> physical;
  if (device.instance) physical = physical_devices(*device.instance);
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice p : physical) infos.push_back(describe(p, static_cast<std::uint32_t>(infos.size())));
  const std::uint32_t chosen = choose_device(infos, config.select);
  device.physical = physical[chosen];
  device.info = infos[chosen];
  device.family = compute_family(device.physical).value();
}

void read_limits(Device& device, Transfer transfer) {
  VkPhysicalDeviceVulkan11Properties v11{};
  v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &v11;
  vkGetPhysicalDeviceProperties2(device.physical, &properties);
  vkGetPhysicalDeviceMemoryProperties(device.physical, &device.memory);
  device.limits = properties.properties.limits;
  device.max_allocation = v11.maxMemoryAllocationSize;
  device.features.unified_memory = transfer == Transfer::automatic && is_unified(device.physical);
}

void create_handle(Device& device, const FeatureChain& wanted) {
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = device.family.index;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &wanted.core;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  QUINCUNX_VK(vkCreateDevice(device.physical, &info, nullptr, &device.handle));
  vkGetDeviceQueue(device.handle, device.family.index, 0, &device.queue);
}

void create_commands(Device& device) {
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = device.family.index;
  QUINCUNX_VK(vkCreateCommandPool(device.handle, &pool, nullptr, &device.command_pool));
  VkCommandBufferAllocateInfo commands{};
  commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  commands.commandPool = device.command_pool;
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  QUINCUNX_VK(vkAllocateCommandBuffers(device.handle, &commands, &device.commands));
  VkFenceCreateInfo fence{};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  QUINCUNX_VK(vkCreateFence(device.handle, &fence, nullptr, &device.fence));
  VkQueryPoolCreateInfo queries{};
  queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = 2;
  QUINCUNX_VK(vkCreateQueryPool(device.handle, &queries, nullptr, &device.timestamps));
}

void destroy_handle(Device& device) {
  save_pipeline_cache(device);
  release(device, device.staging);
  vkDestroyPipelineCache(device.handle, device.pipeline_cache, nullptr);
  vkDestroyQueryPool(device.handle, device.timestamps, nullptr);
  vkDestroyFence(device.handle, device.fence, nullptr);
  vkDestroyCommandPool(device.handle, device.command_pool, nullptr);
  vkDestroyDevice(device.handle, nullptr);
}

// Everything written before is visible to everything after, the host included.
void full_barrier(VkCommandBuffer commands) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                       nullptr);
}

}  // namespace

Device::~Device() {
  const std::size_t said = instance ? instance->messages.size() : 0;
  if (handle) destroy_handle(*this);
  if (!instance) return;
  for (std::size_t i = said; i < instance->messages.size(); ++i) {
    std::fprintf(stderr, "validation, on closing the device: %s\n", instance->messages[i].c_str());
  }
}

std::shared_ptr<Device> open_device(const DeviceConfig& config) {
  auto device = std::make_shared<Device>();
  device->instance = create_instance(!config.validation ? Validation::off : config.gpu_assisted ? Validation::gpu_assisted : Validation::on);
  choose_physical(*device, config);
  read_limits(*device, config.transfer);
  FeatureChain wanted;
  choose_features(*device, wanted, config.validation);
  create_handle(*device, wanted);
  create_commands(*device);
  device->cache_folder = prepare_cache_folder(config.cache_folder);
  load_pipeline_cache(*device);
  return device;
}

const DeviceInfo& info(const Device& device) { return device.info; }

const DeviceFeatures& features(const Device& device) { return device.features; }

std::vector<std::string> validation_messages(const Device& device) {
  const std::lock_guard lock(device.instance->mutex);
  return device.instance->messages;
}

void run_commands(Device& device, const std::function<void(VkCommandBuffer)>& record) {
  QUINCUNX_VK(vkResetCommandPool(device.handle, device.command_pool, 0));
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  QUINCUNX_VK(vkBeginCommandBuffer(device.commands, &begin));
  record(device.commands);
  full_barrier(device.commands);
  QUINCUNX_VK(vkEndCommandBuffer(device.commands));
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &device.commands;
  QUINCUNX_VK(vkQueueSubmit(device.queue, 1, &submit, device.fence));
  QUINCUNX_VK(vkWaitForFences(device.handle, 1, &device.fence, VK_TRUE, UINT64_MAX));
  QUINCUNX_VK(vkResetFences(device.handle, 1, &device.fence));
}

}  // namespace quincunx::gpu

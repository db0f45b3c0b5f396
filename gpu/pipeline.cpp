#include "gpu/pipeline.h"

#include <fmt/format.h>
#include <spirv_cross/spirv.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <vector>

#include "gpu/check.h"
#include "gpu/device_state.h"

namespace quincunx::gpu {
namespace {

using Specialization = std::span<const std::pair<std::string, std::uint32_t>>;

struct PipelineOwner {
  std::shared_ptr<Device> device;
  VkShaderModule module = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkPipeline handle = VK_NULL_HANDLE;

  PipelineOwner() = default;
  PipelineOwner(const PipelineOwner&) = delete;
  PipelineOwner& operator=(const PipelineOwner&) = delete;
  ~PipelineOwner() {
    vkDestroyPipeline(device->handle, handle, nullptr);
    vkDestroyDescriptorPool(device->handle, pool, nullptr);
    vkDestroyPipelineLayout(device->handle, layout, nullptr);
    vkDestroyDescriptorSetLayout(device->handle, set_layout, nullptr);
    vkDestroyShaderModule(device->handle, module, nullptr);
  }
};

// Values in the order of their entries, as VkSpecializationInfo points to them.
struct Constants {
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
};

Constants find_constants(const Reflection& reflection, Specialization specialization) {
  Constants constants;
  for (const auto& [name, value] : specialization) {
    const auto has_name = [&name = name](const auto& constant) { return constant.first == name; };
    const auto found = std::find_if(reflection.specialization.begin(), reflection.specialization.end(), has_name);
    if (found == reflection.specialization.end()) {
      throw std::runtime_error(fmt::format("the kernel has no specialization constant '{}'", name));
    }
    const auto offset = static_cast<std::uint32_t>(constants.values.size() * sizeof(std::uint32_t));
    constants.entries.push_back({found->second, offset, sizeof(std::uint32_t)});
    constants.values.push_back(value);
  }
  return constants;
}

void specialize_local_size(const Constants& constants, Reflection& reflection) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < constants.entries.size(); ++i) {
      const bool mine = constants.entries[i].constantID == reflection.local_size_ids[axis];
      if (mine) reflection.local_size[axis] = constants.values[i];
    }
  }
}

void check_features(const Device& device, const Reflection& reflection) {
  const std::array<std::tuple<std::uint32_t, bool, const char*>, 5> needs = {{
      {SpvCapabilityFloat64, device.features.float64, "64-bit floats"},
      {SpvCapabilityInt64, device.features.int64, "64-bit integers"},
      {SpvCapabilityInt8, device.features.int8, "8-bit integers"},
      {SpvCapabilityStorageBuffer8BitAccess, device.features.storage8, "bytes in storage buffers"},
      {SpvCapabilityPhysicalStorageBufferAddresses, device.features.buffer_address, "device addresses"},
  }};
  for (const auto& [capability, has, what] : needs) {
    const auto& asked = reflection.capabilities;
    if (has || std::find(asked.begin(), asked.end(), capability) == asked.end()) continue;
    throw DeviceError(fmt::format("the kernel needs {}, which {} does not have", what, device.info.name));
  }
}

void check_sizes(const Device& device, const Reflection& reflection) {
  const auto& size = reflection.local_size;
  const auto& limit = device.limits.maxComputeWorkGroupSize;
  const std::uint64_t lanes = std::uint64_t{size[0]} * size[1] * size[2];
  const bool fits = size[0] <= limit[0] && size[1] <= limit[1] && size[2] <= limit[2] && lanes > 0 &&
                    lanes <= device.limits.maxComputeWorkGroupInvocations;
  if (!fits) {
    throw DeviceError(fmt::format("a work group of {} x {} x {} is not 1 to {} lanes, as {} allows", size[0], size[1],
                                  size[2], device.limits.maxComputeWorkGroupInvocations, device.info.name));
  }
  if (reflection.push_constant_bytes > device.limits.maxPushConstantsSize) {
    throw DeviceError(fmt::format("the kernel's push constants take {} bytes; {} allows {}",
                                  reflection.push_constant_bytes, device.info.name,
                                  device.limits.maxPushConstantsSize));
  }
}

void create_layout(PipelineOwner& owner, const Reflection& reflection) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const Binding& b : reflection.bindings) {
    bindings.push_back({b.binding, b.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo set{};
  set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set.bindingCount = static_cast<std::uint32_t>(bindings.size());
  set.pBindings = bindings.data();
  QUINCUNX_VK(vkCreateDescriptorSetLayout(owner.device->handle, &set, nullptr, &owner.set_layout));

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, reflection.push_constant_bytes};
  VkPipelineLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &owner.set_layout;
  layout.pushConstantRangeCount = push.size > 0 ? 1 : 0;
  layout.pPushConstantRanges = &push;
  QUINCUNX_VK(vkCreatePipelineLayout(owner.device->handle, &layout, nullptr, &owner.layout));
}

VkDescriptorSet create_set(PipelineOwner& owner, const Reflection& reflection) {
  std::map<VkDescriptorType, std::uint32_t> counts;
  for (const Binding& binding : reflection.bindings) ++counts[binding.type];
  if (counts.empty()) return VK_NULL_HANDLE;
  std::vector<VkDescriptorPoolSize> sizes;
  for (const auto& [type, count] : counts) sizes.push_back({type, count});
  VkDescriptorPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.maxSets = 1;
  pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  pool.pPoolSizes = sizes.data();
  QUINCUNX_VK(vkCreateDescriptorPool(owner.device->handle, &pool, nullptr, &owner.pool));
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = owner.pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &owner.set_layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  QUINCUNX_VK(vkAllocateDescriptorSets(owner.device->handle, &info, &set));
  return set;
}

void create_module(PipelineOwner& owner, std::span<const std::uint32_t> spirv) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = spirv.size_bytes();
  info.pCode = spirv.data();
  QUINCUNX_VK(vkCreateShaderModule(owner.device->handle, &info, nullptr, &owner.module));
}

void create_handle(PipelineOwner& owner, const Constants& constants) {
  VkSpecializationInfo specialization{};
  specialization.mapEntryCount = static_cast<std::uint32_t>(constants.entries.size());
  specialization.pMapEntries = constants.entries.data();
  specialization.dataSize = constants.values.size() * sizeof(std::uint32_t);
  specialization.pData = constants.values.data();
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = owner.module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = owner.layout;
  QUINCUNX_VK(
      vkCreateComputePipelines(owner.device->handle, owner.device->pipeline_cache, 1, &info, nullptr, &owner.handle));
}

}  // namespace

Pipeline create_pipeline(Device& device, std::span<const std::uint32_t> spirv, Specialization specialization) {
  Pipeline pipeline;
  pipeline.reflection = reflect(spirv);
  const Constants constants = find_constants(pipeline.reflection, specialization);
  specialize_local_size(constants, pipeline.reflection);
  check_features(device, pipeline.reflection);
  check_sizes(device, pipeline.reflection);

  auto owner = std::make_shared<PipelineOwner>();
  owner->device = device.shared_from_this();
  create_module(*owner, spirv);
  create_layout(*owner, pipeline.reflection);
  pipeline.set = create_set(*owner, pipeline.reflection);
  create_handle(*owner, constants);

  pipeline.handle = owner->handle;
  pipeline.layout = owner->layout;
  pipeline.set_layout = owner->set_layout;
  pipeline.owner = std::move(owner);
  return pipeline;
}

}  // namespace quincunx::gpu

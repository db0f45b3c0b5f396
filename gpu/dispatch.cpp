#include "gpu/dispatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "gpu/buffer_owner.h"
#include "gpu/check.h"

namespace quincunx::gpu {
namespace {

using Groups = std::array<std::uint32_t, 3>;

std::string binding_names(const Pipeline& pipeline) {
  std::string names;
  for (const Binding& binding : pipeline.reflection.bindings) names += (names.empty() ? "" : ", ") + binding.name;
  return names.empty() ? "none" : names;
}

const Buffer& find_buffer(const Binding& binding, const Resources& resources) {
  const auto has_name = [&](const auto& resource) { return resource.first == binding.name; };
  const auto found = std::find_if(resources.begin(), resources.end(), has_name);
  if (found == resources.end()) {
    throw std::runtime_error(fmt::format("the kernel's resource '{}' was not given", binding.name));
  }
  return found->second;
}

void check_none_too_many(const Pipeline& pipeline, const Resources& resources) {
  const auto& bindings = pipeline.reflection.bindings;
  for (std::size_t i = 0; i < resources.size(); ++i) {
    const std::string& name = resources[i].first;
    const auto mine = [&](const Binding& binding) { return binding.name == name; };
    if (std::none_of(bindings.begin(), bindings.end(), mine)) {
      throw std::runtime_error(
          fmt::format("the kernel has no resource '{}'; it has {}", name, binding_names(pipeline)));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (resources[j].first == name) throw std::runtime_error(fmt::format("the resource '{}' was given twice", name));
    }
  }
}

void check_buffer(const Device& device, const Binding& binding, const Buffer& buffer) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("the kernel's resource '{}' {}", binding.name, why));
  };
  if (!buffer.owner) fail("was given an empty buffer");
  const BufferUse use = owner_of(buffer).use;
  if (owner_of(buffer).device.get() != &device) fail("was given a buffer of another device");
  if (binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) {
    if (use != BufferUse::texel) fail("is a texel buffer and was given another kind");
  } else if (binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
    if (use != BufferUse::uniform) fail("is a uniform block and was given another kind of buffer");
    if (buffer.bytes < binding.struct_bytes)
      fail(fmt::format("takes {} bytes; its buffer has {}", binding.struct_bytes, buffer.bytes));
  } else {
    if (use == BufferUse::uniform) fail("is a storage block and was given a uniform buffer");
    const std::uint64_t limit = device.limits.maxStorageBufferRange;
    if (buffer.bytes > limit) fail(fmt::format("has {} bytes; one storage buffer may have {}", buffer.bytes, limit));
  }
}

void write_set(Device& device, const Pipeline& pipeline, const Resources& resources) {
  const auto& bindings = pipeline.reflection.bindings;
  std::vector<VkDescriptorBufferInfo> infos(bindings.size());  // kept in place: the writes point to them
  std::vector<VkWriteDescriptorSet> writes;
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    const Buffer& buffer = find_buffer(bindings[i], resources);
    check_buffer(device, bindings[i], buffer);
    infos[i] = {buffer.handle, 0, buffer.bytes};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = pipeline.set;
    write.dstBinding = bindings[i].binding;
    write.descriptorCount = 1;
    write.descriptorType = bindings[i].type;
    write.pBufferInfo = &infos[i];
    write.pTexelBufferView = &buffer.view;
    writes.push_back(write);
  }
  vkUpdateDescriptorSets(device.handle, static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

void check_call(const Device& device, const Pipeline& pipeline, std::span<const std::byte> push, const Groups& groups) {
  if (push.size() != pipeline.reflection.push_constant_bytes) {
    throw std::runtime_error(fmt::format("the kernel's push constants have {} bytes, {} were given",
                                         pipeline.reflection.push_constant_bytes, push.size()));
  }
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::uint32_t limit = device.limits.maxComputeWorkGroupCount[axis];
    if (groups[axis] > limit) {
      throw DeviceError(
          fmt::format("{} work groups along axis {}; {} allows {}", groups[axis], axis, device.info.name, limit));
    }
  }
}

void record(const Device& device, const Pipeline& pipeline, std::span<const std::byte> push, const Groups& groups,
            VkCommandBuffer commands) {
  vkCmdResetQueryPool(commands, device.timestamps, 0, 2);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle);
  if (pipeline.set) {
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &pipeline.set, 0, nullptr);
  }
  if (!push.empty()) {
    vkCmdPushConstants(commands, pipeline.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<std::uint32_t>(push.size()), push.data());
  }
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, device.timestamps, 0);
  vkCmdDispatch(commands, groups[0], groups[1], groups[2]);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, device.timestamps, 1);
}

double elapsed_ms(const Device& device) {
  std::array<std::uint64_t, 2> ticks{};
  QUINCUNX_VK(vkGetQueryPoolResults(device.handle, device.timestamps, 0, 2, sizeof(ticks), ticks.data(),
                                    sizeof(ticks[0]), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  const std::uint32_t bits = device.family.timestamp_bits;
  const std::uint64_t mask = bits >= 64 ? UINT64_MAX : (std::uint64_t{1} << bits) - 1;
  // The difference modulo 2^bits is right also where the counter has wrapped around in between.
  return static_cast<double>((ticks[1] - ticks[0]) & mask) * device.limits.timestampPeriod * 1e-6;
}

}  // namespace

double dispatch(Device& device, const Pipeline& pipeline, const Resources& resources, std::span<const std::byte> push,
                std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) {
  const Groups groups = {groups_x, groups_y, groups_z};
  check_call(device, pipeline, push, groups);
  check_none_too_many(pipeline, resources);
  const std::lock_guard lock(device.mutex);
  write_set(device, pipeline, resources);
  if (std::find(groups.begin(), groups.end(), 0u) != groups.end()) return 0.0;
  run_commands(device, [&](VkCommandBuffer commands) { record(device, pipeline, push, groups, commands); });
  return elapsed_ms(device);
}

}  // namespace quincunx::gpu

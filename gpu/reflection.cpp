#include "gpu/reflection.h"

#include <fmt/format.h>
#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

namespace quincunx::gpu {
namespace {

using Context = std::unique_ptr<spvc_context_s, decltype(&spvc_context_destroy)>;

// One kernel under SPIRV-Cross: the context owns everything that its calls return.
struct Module {
  Context context{nullptr, spvc_context_destroy};
  spvc_compiler compiler = nullptr;
  spvc_resources resources = nullptr;

  void check(spvc_result result) const {
    if (result == SPVC_SUCCESS) return;
    throw std::runtime_error(std::string("reflection of a kernel: ") +
                             spvc_context_get_last_error_string(context.get()));
  }
};

Module parse(std::span<const std::uint32_t> spirv) {
  Module module;
  spvc_context context = nullptr;
  if (spvc_context_create(&context) != SPVC_SUCCESS) throw std::runtime_error("reflection of a kernel: out of memory");
  module.context.reset(context);
  spvc_parsed_ir ir = nullptr;
  module.check(spvc_context_parse_spirv(context, spirv.data(), spirv.size(), &ir));
  module.check(
      spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &module.compiler));
  if (spvc_compiler_get_execution_model(module.compiler) != SpvExecutionModelGLCompute) {
    throw std::runtime_error("reflection of a kernel: not a compute kernel");
  }
  spvc_set active = nullptr;
  module.check(spvc_compiler_get_active_interface_variables(module.compiler, &active));
  module.check(spvc_compiler_create_shader_resources_for_active_variables(module.compiler, &module.resources, active));
  return module;
}

std::span<const spvc_reflected_resource> resources_of(const Module& module, spvc_resource_type type) {
  const spvc_reflected_resource* list = nullptr;
  std::size_t count = 0;
  module.check(spvc_resources_get_resource_list_for_type(module.resources, type, &list, &count));
  return {list, count};
}

std::string resource_name(const Module& module, const spvc_reflected_resource& resource) {
  const std::string instance = spvc_compiler_get_name(module.compiler, resource.id);
  return instance.empty() ? spvc_compiler_get_name(module.compiler, resource.base_type_id) : instance;
}

spvc_type type_of(const Module& module, spvc_type_id id) { return spvc_compiler_get_type_handle(module.compiler, id); }

// Members of `type`, those of nested structs instead of the struct; of arrays of structs the first element.
void add_members(const Module& module, spvc_type type, const std::string& block, const std::string& prefix,
                 std::uint32_t base, std::vector<BlockMember>& members) {
  const spvc_type_id id = spvc_type_get_base_type_id(type);
  const spvc_type plain = type_of(module, id);
  for (unsigned i = 0; i < spvc_type_get_num_member_types(plain); ++i) {
    unsigned offset = 0;
    module.check(spvc_compiler_type_struct_member_offset(module.compiler, plain, i, &offset));
    const std::string name = prefix + spvc_compiler_get_member_name(module.compiler, id, i);
    const spvc_type member = type_of(module, spvc_type_get_member_type(plain, i));
    const bool pointer = spvc_type_get_storage_class(member) == SpvStorageClassPhysicalStorageBuffer;
    if (spvc_type_get_basetype(member) == SPVC_BASETYPE_STRUCT && !pointer) {
      const std::string element = spvc_type_get_num_array_dimensions(member) > 0 ? "[0]." : ".";
      add_members(module, member, block, name + element, base + offset, members);
    } else {
      members.push_back({block, name, base + offset});
    }
  }
}

std::uint64_t declared_bytes(const Module& module, const spvc_reflected_resource& resource) {
  std::size_t bytes = 0;
  module.check(spvc_compiler_get_declared_struct_size(module.compiler, type_of(module, resource.base_type_id), &bytes));
  return bytes;
}

bool is_buffer_image(const Module& module, const spvc_reflected_resource& resource) {
  return spvc_type_get_image_dimension(type_of(module, resource.base_type_id)) == SpvDimBuffer;
}

void add_binding(const Module& module, const spvc_reflected_resource& resource, VkDescriptorType type,
                 Reflection& reflection) {
  Binding binding;
  binding.name = resource_name(module, resource);
  binding.binding = spvc_compiler_get_decoration(module.compiler, resource.id, SpvDecorationBinding);
  binding.type = type;
  const unsigned set = spvc_compiler_get_decoration(module.compiler, resource.id, SpvDecorationDescriptorSet);
  if (set != 0)
    throw std::runtime_error(
        fmt::format("kernel resource '{}' is in set {}; only set 0 is offered", binding.name, set));
  if (spvc_type_get_num_array_dimensions(type_of(module, resource.type_id)) > 0) {
    throw std::runtime_error(
        fmt::format("kernel resource '{}' is an array of resources, which is not offered", binding.name));
  }
  if (type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) binding.struct_bytes = declared_bytes(module, resource);
  reflection.bindings.push_back(binding);
}

void add_blocks(const Module& module, spvc_resource_type kind, VkDescriptorType type, Reflection& reflection) {
  for (const spvc_reflected_resource& resource : resources_of(module, kind)) {
    add_binding(module, resource, type, reflection);
    add_members(module, type_of(module, resource.base_type_id), reflection.bindings.back().name, "", 0,
                reflection.members);
  }
}

void add_texel_buffers(const Module& module, Reflection& reflection) {
  for (const auto kind :
       {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, SPVC_RESOURCE_TYPE_STORAGE_IMAGE,
        SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE}) {
    const bool read_only = kind == SPVC_RESOURCE_TYPE_SAMPLED_IMAGE || kind == SPVC_RESOURCE_TYPE_SEPARATE_IMAGE;
    for (const spvc_reflected_resource& resource : resources_of(module, kind)) {
      if (!read_only || !is_buffer_image(module, resource)) {
        throw std::runtime_error(
            fmt::format("kernel resource '{}' is neither a buffer block, a uniform block nor a samplerBuffer",
                        resource_name(module, resource)));
      }
      add_binding(module, resource, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, reflection);
    }
  }
}

void add_push_constants(const Module& module, Reflection& reflection) {
  for (const spvc_reflected_resource& resource : resources_of(module, SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
    reflection.push_constant_bytes = static_cast<std::uint32_t>(declared_bytes(module, resource));
    add_members(module, type_of(module, resource.base_type_id), resource_name(module, resource), "", 0,
                reflection.members);
  }
}

void add_specialization(const Module& module, Reflection& reflection) {
  const spvc_specialization_constant* list = nullptr;
  std::size_t count = 0;
  module.check(spvc_compiler_get_specialization_constants(module.compiler, &list, &count));
  for (const auto& constant : std::span(list, count)) {
    reflection.specialization.emplace_back(spvc_compiler_get_name(module.compiler, constant.id), constant.constant_id);
  }
}

void add_local_size(const Module& module, Reflection& reflection) {
  std::array<spvc_specialization_constant, 3> ids{};
  spvc_compiler_get_work_group_size_specialization_constants(module.compiler, &ids[0], &ids[1], &ids[2]);
  for (unsigned axis = 0; axis < 3; ++axis) {
    reflection.local_size[axis] =
        spvc_compiler_get_execution_mode_argument_by_index(module.compiler, SpvExecutionModeLocalSize, axis);
    if (ids[axis].id != 0) reflection.local_size_ids[axis] = ids[axis].constant_id;
  }
}

void add_capabilities(const Module& module, Reflection& reflection) {
  const SpvCapability* list = nullptr;
  std::size_t count = 0;
  module.check(spvc_compiler_get_declared_capabilities(module.compiler, &list, &count));
  for (SpvCapability capability : std::span(list, count)) {
    reflection.capabilities.push_back(static_cast<std::uint32_t>(capability));
  }
}

void sort_bindings(Reflection& reflection) {
  auto& bindings = reflection.bindings;
  std::sort(bindings.begin(), bindings.end(), [](const Binding& a, const Binding& b) { return a.binding < b.binding; });
  const auto same = std::adjacent_find(bindings.begin(), bindings.end(),
                                       [](const Binding& a, const Binding& b) { return a.binding == b.binding; });
  if (same == bindings.end()) return;
  throw std::runtime_error(fmt::format("kernel resources '{}' and '{}' have the same binding {}", same->name,
                                       (same + 1)->name, same->binding));
}

}  // namespace

Reflection reflect(std::span<const std::uint32_t> spirv) {
  const Module module = parse(spirv);
  Reflection reflection;
  add_blocks(module, SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, reflection);
  add_blocks(module, SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, reflection);
  add_texel_buffers(module, reflection);
  add_push_constants(module, reflection);
  add_specialization(module, reflection);
  add_local_size(module, reflection);
  add_capabilities(module, reflection);
  sort_bindings(reflection);
  return reflection;
}

}  // namespace quincunx::gpu

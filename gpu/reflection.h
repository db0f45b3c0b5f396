// What a compiled kernel asks for.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace quincunx::gpu {

/// A resource a kernel declares, by reflection.
struct Binding {
  std::string name;  ///< the block's instance name (the block's own where it has none) or variable name, as in GLSL
  std::uint32_t binding = 0;
  VkDescriptorType type{};
  std::uint64_t struct_bytes = 0;  ///< uniform blocks: declared size
};

/// A member of a block, for comparing a C++ struct's offsets with the compiled kernel.
struct BlockMember {
  std::string block, name;   ///< block: as Binding::name; members of members as "camera.eye", "lights[0].color"
  std::uint32_t offset = 0;  ///< bytes from the start of the block
};

struct Reflection {
  std::vector<Binding> bindings;     ///< set 0, by number, those the kernel really uses
  std::vector<BlockMember> members;  ///< of uniform blocks, storage blocks and the push constant block
  std::uint32_t push_constant_bytes = 0;
  std::vector<std::pair<std::string, std::uint32_t>> specialization;  ///< name, constant_id
  std::uint32_t local_size[3] = {1, 1, 1};  ///< of a Pipeline: as specialized; else the default
  std::uint32_t local_size_ids[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};  ///< constant_id of local_size_?_id, if any
  std::vector<std::uint32_t> capabilities;                                 ///< SpvCapability
};

/// Throws std::runtime_error for words that are no SPIR-V compute kernel, or for resources that gpu/ does not offer:
/// sets other than 0, arrays of resources, images, two resources of one number.
Reflection reflect(std::span<const std::uint32_t> spirv);

}  // namespace quincunx::gpu

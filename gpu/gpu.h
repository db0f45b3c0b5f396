// Vulkan compute as plain structs and free functions. Knows nothing of volumes.
//
// Errors: DeviceError for a device that is not there or cannot do what is asked (a user's to mend);
// std::runtime_error with the call's text for any Vulkan call that fails; ShaderError for GLSL that does not compile.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace quincunx::gpu {

class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
class ShaderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// ---- devices ----

struct DeviceInfo {
  std::uint32_t index = 0;  ///< position in the list, what --device takes
  std::string name, driver, type;  ///< type: "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
  std::uint32_t api_version = 0;
  std::uint64_t memory_bytes = 0;  ///< largest device-local heap
  std::uint64_t max_storage_buffer_range = 0, max_texel_buffer_elements = 0;
  bool usable = false;  ///< Vulkan 1.2 or later with a compute queue and timestamps
};

/// All Vulkan devices; empty where there is no Vulkan loader or driver.
std::vector<DeviceInfo> list_devices();

struct DeviceConfig {
  std::string select;       ///< "": discrete before integrated before virtual before CPU; an index; or a part of a name (case ignored)
  bool validation = false;  ///< turn the validation layer on; its messages are collected (Device::validation_messages)
  std::string cache_folder; ///< SPIR-V by content and the pipeline cache; "": $XDG_CACHE_HOME or ~/.cache, /quincunx; unwritable: no cache
};

class Device;  // owns instance, device, queue, command pool, pipeline cache; neither copied nor moved
std::shared_ptr<Device> open_device(const DeviceConfig& config);
const DeviceInfo& info(const Device& device);
/// Warnings and errors the validation layer gave since the device was opened; empty means silent.
std::vector<std::string> validation_messages(const Device& device);

// ---- memory ----

enum class BufferUse { storage, uniform, texel };  ///< texel: uniform texel buffer (samplerBuffer), read-only for kernels; also storage

/// A device-local buffer, mapped where the device's memory is the host's. Destroyed with the last copy of the handle.
struct Buffer {
  std::shared_ptr<void> owner;
  VkBuffer handle = VK_NULL_HANDLE;
  VkBufferView view = VK_NULL_HANDLE;  ///< texel buffers only
  std::uint64_t bytes = 0;
  VkDeviceAddress address = 0;         ///< where the device has bufferDeviceAddress
};

/// Throws DeviceError naming `label` and the bytes where memory is short or a limit (max_storage_buffer_range,
/// max_texel_buffer_elements) is passed. Contents start as zeros. `bytes` 0 is taken as 4.
Buffer create_buffer(Device& device, std::uint64_t bytes, BufferUse use, const std::string& label,
                     VkFormat texel_format = VK_FORMAT_UNDEFINED);
void upload(Device& device, const Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t offset = 0);
void download(Device& device, const Buffer& buffer, std::span<std::byte> bytes, std::uint64_t offset = 0);

// ---- shaders ----

/// Finds the text of an include by its file name; empty function result = not found.
using ShaderFiles = std::function<std::string_view(std::string_view name)>;

/// A kernel as it is composed: the file with main(), and defines in order (name, value).
struct KernelSource {
  std::string file;
  std::vector<std::pair<std::string, std::string>> defines;
};

/// GLSL with its includes (GL_GOOGLE_include_directive) compiled to SPIR-V for Vulkan 1.2 by glslang, optimised for performance where
/// SPIRV-Tools is there; from the disk cache where the same content was compiled before. Keeps debug names (OpName) of functions.
/// Throws ShaderError with file and line.
std::vector<std::uint32_t> compile(const Device& device, const ShaderFiles& files, const KernelSource& source);
/// Without a device and without a cache (for tests).
std::vector<std::uint32_t> compile(const ShaderFiles& files, const KernelSource& source);

/// A resource a kernel declares, by reflection.
struct Binding {
  std::string name;  ///< the block's instance or variable name as in GLSL
  std::uint32_t binding = 0;
  VkDescriptorType type{};
  std::uint64_t struct_bytes = 0;  ///< uniform blocks: declared size
};
/// A member of a block, for comparing a C++ struct's offsets with the compiled kernel.
struct BlockMember {
  std::string block, name;
  std::uint32_t offset = 0;
};
struct Reflection {
  std::vector<Binding> bindings;        ///< set 0, those the kernel really uses
  std::vector<BlockMember> members;     ///< of uniform blocks and the push constant block
  std::uint32_t push_constant_bytes = 0;
  std::vector<std::pair<std::string, std::uint32_t>> specialization;  ///< name, constant_id
  std::uint32_t local_size[3] = {1, 1, 1};
};
Reflection reflect(std::span<const std::uint32_t> spirv);

// ---- pipelines ----

/// A compute pipeline; bindings come from reflection. Specialization constants are given by name;
/// a name the kernel does not have is an error (std::runtime_error), one not given keeps its default.
struct Pipeline {
  std::shared_ptr<void> owner;
  VkPipeline handle = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  Reflection reflection;
};
Pipeline create_pipeline(Device& device, std::span<const std::uint32_t> spirv,
                         std::span<const std::pair<std::string, std::uint32_t>> specialization = {});

// ---- running ----

/// Resources by the kernel's names; one missing or one too many is a std::runtime_error naming it.
using Resources = std::vector<std::pair<std::string, Buffer>>;

/// Runs the kernel over groups, waits for its end (all barriers inside), and returns its time in milliseconds by
/// timestamp queries. `push` is copied to the push constants and must have their size.
double dispatch(Device& device, const Pipeline& pipeline, const Resources& resources, std::span<const std::byte> push,
                std::uint32_t groups_x, std::uint32_t groups_y = 1, std::uint32_t groups_z = 1);

}  // namespace quincunx::gpu

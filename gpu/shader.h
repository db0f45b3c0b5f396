// Kernels composed from GLSL files and compiled to SPIR-V.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "gpu/error.h"

namespace quincunx::gpu {

/// Finds the text of a file by its name, e.g. "shared/frame.h"; an empty result = not found. Texts outlive the call.
using ShaderFiles = std::function<std::string_view(std::string_view name)>;

/// A kernel as it is composed: the file with main(), and defines in order (name, value).
struct KernelSource {
  std::string file;
  std::vector<std::pair<std::string, std::string>> defines;
};

/// GLSL compiled by glslang to SPIR-V 1.5 for Vulkan 1.2; from the disk cache where the same was compiled before.
/// `#include "name"` needs no extension line; the name is sought beside the including file, then as it stands. A file
/// with `#pragma once` is included once. Not optimised, so that functions keep their names (OpName) and a kernel can be
/// asked what it contains: drivers optimise themselves.
/// Throws ShaderError "file:line: what" of the first error, also for included files.
std::vector<std::uint32_t> compile(const Device& device, const ShaderFiles& files, const KernelSource& source);
/// Without a device and without a cache (for tests).
std::vector<std::uint32_t> compile(const ShaderFiles& files, const KernelSource& source);

}  // namespace quincunx::gpu

// The files of a kernel: includes resolved, and the content hash that names its SPIR-V. Private to gpu/.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "gpu/shader.h"

namespace quincunx::gpu {

/// Every file that the kernel includes in one of its variants, by resolved name.
using SourceTexts = std::map<std::string, std::string_view, std::less<>>;

/// The name under which `files` knows what `includer` includes as `name`: beside the includer, then as it stands.
/// Empty where there is none.
std::string resolve_include(const ShaderFiles& files, std::string_view name, std::string_view includer);

/// Follows every `#include "..."` from source.file, whatever #if it stands under: a superset of what is compiled.
/// Throws ShaderError where source.file itself is missing; missing includes are left to the compiler.
SourceTexts collect_sources(const ShaderFiles& files, const KernelSource& source);

/// The defines as lines of GLSL.
std::string define_lines(const KernelSource& source);

/// A hash of the texts, the defines and the compiler: equal only for equal SPIR-V. Hexadecimal.
std::string content_key(const SourceTexts& texts, const KernelSource& source);

bool has_pragma_once(std::string_view text);

}  // namespace quincunx::gpu

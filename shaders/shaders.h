// The GLSL files of this folder, inside the binary.
#pragma once

#include <string_view>
#include <vector>

namespace quincunx {

/// The text of a file, by its name relative to shaders/: "bcc7.glsl", "shared/frame.h". Empty where there is none.
/// Lives as long as the program.
std::string_view shader_file(std::string_view name);

/// All names, sorted.
std::vector<std::string_view> shader_file_names();

}  // namespace quincunx

// Text files that appear whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace quincunx {

/// Throws InputError, naming `path`, unless a file can be made there: its folder is there and writable, and `path` is
/// no folder itself. Asked before long work, so that it does not fail at its end.
void check_output_path(const std::string& path);

/// Writes `text` beside `path`, then renames. Throws InputError where the place cannot be written.
void write_text_file(const std::string& path, std::string_view text);

}  // namespace quincunx

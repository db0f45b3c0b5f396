// The files of bench/page, inside the program (cmake/embed.cmake).
#pragma once

#include <cstddef>
#include <string_view>

namespace quincunx::page_files {

struct File {
  std::string_view name;
  const char* text;
  std::size_t bytes;
};

extern const File kFiles[];  ///< kFileCount of them, and one empty one
extern const std::size_t kFileCount;

}  // namespace quincunx::page_files

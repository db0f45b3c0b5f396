// What cmake/embed.cmake writes. Private to shaders/.
#pragma once

#include <cstddef>
#include <string_view>

namespace quincunx::embedded {

struct File {
  std::string_view name;
  const char* text;
  std::size_t bytes;
};

extern const File kFiles[];  ///< kFileCount of them, and one empty one
extern const std::size_t kFileCount;

}  // namespace quincunx::embedded

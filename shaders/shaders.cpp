#include "shaders/shaders.h"

#include <algorithm>

#include "shaders/embedded.h"

namespace quincunx {

std::string_view shader_file(std::string_view name) {
  for (std::size_t i = 0; i < embedded::kFileCount; ++i) {
    const embedded::File& file = embedded::kFiles[i];
    if (file.name == name) return {file.text, file.bytes};
  }
  return {};
}

std::vector<std::string_view> shader_file_names() {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < embedded::kFileCount; ++i) names.push_back(embedded::kFiles[i].name);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace quincunx

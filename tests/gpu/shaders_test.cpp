#include "shaders/shaders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace quincunx {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_on_disk(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    const std::string extension = entry.path().extension().string();
    const bool shared_header = extension == ".h" && name.starts_with("shared/");
    if (extension == ".glsl" || extension == ".comp" || shared_header) names.push_back(name);
  }
  return names;
}

TEST(Shaders, EveryFileOfTheFolderIsInsideByteForByte) {
  const fs::path folder = fs::path(QUINCUNX_SOURCE_DIR) / "shaders";
  EXPECT_THAT(shader_file_names(), ::testing::Not(::testing::IsEmpty()));
  EXPECT_THAT(shader_file_names(), ::testing::UnorderedElementsAreArray(names_on_disk(folder)));
  for (std::string_view name : shader_file_names()) {
    std::ifstream file(folder / name, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_TRUE(shader_file(name) == text) << name;
  }
}

TEST(Shaders, AFileThatIsNotThereIsEmpty) {
  EXPECT_TRUE(shader_file("no such file.glsl").empty());
  EXPECT_TRUE(shader_file("").empty());
}

}  // namespace
}  // namespace quincunx

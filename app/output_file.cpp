#include "app/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "lattice/error.h"

namespace quincunx {

namespace fs = std::filesystem;

void check_output_path(const std::string& path) {
  std::error_code ignored;
  const fs::path file(path);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (path.empty()) throw InputError("'': an empty path, expected one of a file to write");
  if (!file.has_filename() || fs::is_directory(file, ignored)) {
    throw InputError(fmt::format("{}: found a folder, expected the path of a file to write", path));
  }
  if (!fs::is_directory(folder, ignored)) {
    throw InputError(fmt::format("{}: cannot be written: there is no folder {}", path, folder.string()));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(fmt::format("{}: cannot be written: folder {}: {}", path, folder.string(), std::strerror(errno)));
  }
}

void write_text_file(const std::string& path, std::string_view text) {
  const std::string beside = fmt::format("{}.{}.part", path, getpid());
  std::ofstream file(beside, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(beside, path, error);
  if (!file || error) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw InputError(fmt::format("{}: cannot be written: {}", path, error ? error.message() : std::strerror(errno)));
  }
}

}  // namespace quincunx

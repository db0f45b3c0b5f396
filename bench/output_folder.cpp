#include "bench/output_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace fs = std::filesystem;

OutputFolder::OutputFolder(std::string path) : path_(std::move(path)) {
  std::error_code ignored;
  if (path_.empty()) throw InputError("-o: found an empty path, expected a folder");
  if (fs::is_directory(path_, ignored)) return;
  if (fs::exists(fs::symlink_status(path_, ignored)))
    throw InputError(fmt::format("-o: {}: found something else than a folder, expected a folder or nothing", path_));
  // "folder/" has an empty last part.
  const fs::path whole = fs::absolute(path_).lexically_normal(), parent = (whole.has_filename() ? whole : whole.parent_path()).parent_path();
  if (!fs::is_directory(parent, ignored))
    throw InputError(fmt::format("-o: {}: found no folder {} to make it in, expected one", path_, parent.string()));
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (made_) fs::remove(path_, ignored);  // leaves a folder that has files
}

void OutputFolder::prepare(const std::vector<std::string>& names) {
  std::error_code error;
  made_ = fs::create_directory(path_, error);
  if (error) throw InputError(fmt::format("-o: {}: cannot be made: {}", path_, error.message()));
  for (const std::string& name : names) check_writable(file(name));
}

std::string OutputFolder::file(const std::string& name) const { return (fs::path(path_) / name).string(); }

}  // namespace quincunx

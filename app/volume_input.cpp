#include "app/volume_input.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/volume_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// "head.nrrd" or "head.nhdr" -> "head_bcc.nrrd".
std::string bcc_path(const std::string& path) {
  std::filesystem::path out(path);
  out.replace_extension();
  return out.string() + "_bcc.nrrd";
}

}  // namespace

Volume read_finite_volume(const std::string& path, const Progress& progress, const NanPolicy& nan) {
  Volume volume = read_volume(path, progress);
  if (nan.kind == NanPolicy::Kind::refuse) check_finite(sample_range(volume), volume, path);
  return volume;
}

Volume read_bcc_volume(const std::string& path, const Progress& progress, const NanPolicy& nan) {
  Volume volume = read_finite_volume(path, progress, nan);
  if (volume.lattice != LatticeKind::bcc) {
    throw InputError(
        fmt::format("{}: found a Cartesian volume, expected a BCC one; make one of its even and odd points: "
                    "quincunx convert {} {} --lattice bcc",
                    path, shell_quoted(path), shell_quoted(bcc_path(path))));
  }
  return volume;
}

std::string shell_quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789_-+=./:,@%") == std::string::npos;
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace quincunx

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

/// Where sample `number` stands, as "index (i, j, k)", of a BCC volume with its coset.
std::string place_text(const Volume& volume, std::size_t number) {
  const std::size_t nx = std::size_t(volume.extents.x), ny = std::size_t(volume.extents.y);
  const std::size_t nz = std::size_t(volume.extents.z);
  const std::string index = fmt::format("index ({}, {}, {})", number % nx, number / nx % ny, number / (nx * ny) % nz);
  return volume.lattice == LatticeKind::bcc ? fmt::format("coset {}, {}", number / (nx * ny * nz), index) : index;
}

}  // namespace

Volume read_finite_volume(const std::string& path, const Progress& progress) {
  Volume volume = read_volume(path, progress);
  const SampleRange range = sample_range(volume);
  if (range.not_finite > 0) {
    throw InputError(fmt::format("{}: {} of {} samples are NaN or infinite, the first at {}; expected finite samples",
                                 path, range.not_finite, volume.sample_count(),
                                 place_text(volume, range.first_not_finite)));
  }
  return volume;
}

Volume read_bcc_volume(const std::string& path, const Progress& progress) {
  Volume volume = read_finite_volume(path, progress);
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

#include "io/sample_file.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "io/nrrd_header.h"
#include "io/nrrd_samples.h"
#include "io/scratch_file.h"

namespace quincunx {
namespace {

constexpr std::uint64_t kWorthSkipping = 4096;  // bytes between two rows: fewer are read faster than another read begins

/// Reads `rows` rows of `bytes`, `pitch` apart, one after another into `to`.
void read_rows(const InputFile& file, std::uint64_t position, std::uint64_t rows, std::uint64_t bytes, std::uint64_t pitch, std::byte* to,
               std::vector<std::byte>& scratch) {
  if (rows == 1 || pitch == bytes) {
    file.read_at(position, to, std::size_t(rows * bytes));
  } else if (pitch - bytes >= kWorthSkipping) {
    for (std::uint64_t row = 0; row < rows; ++row) file.read_at(position + row * pitch, to + row * bytes, std::size_t(bytes));
  } else {
    scratch.resize(std::size_t((rows - 1) * pitch + bytes));
    file.read_at(position, scratch.data(), scratch.size());
    for (std::uint64_t row = 0; row < rows; ++row) std::memcpy(to + row * bytes, scratch.data() + row * pitch, std::size_t(bytes));
  }
}

}  // namespace

SampleFile::SampleFile(const std::string& path, const Config& config, const Progress& progress) {
  auto file = std::make_unique<InputFile>(path);
  const NrrdHeader header = interpret_nrrd(read_nrrd_text(*file));
  if (!header.data_file.empty()) file = std::make_unique<InputFile>(header.data_file);
  header_ = volume_of(header);
  if (header.encoding == NrrdEncoding::raw) {
    begin_ = raw_nrrd_begin(*file, header);
    swap_bytes_ = header.swap_bytes;
    samples_ = std::move(file);
    return;
  }
  // The scratch file is made for the first samples: a file whose length is wrong is refused before.
  scratch_bytes_ = header.sample_count * sample_type_bytes(header.type);
  std::optional<ScratchFile> scratch;
  unpack_nrrd_samples(
      *file, header,
      [&](std::span<const std::byte> samples) {
        if (!scratch) scratch.emplace(config.scratch, scratch_bytes_, file->path());
        scratch->write(samples);
      },
      progress);
  samples_ = scratch->finish();
}

Volume SampleFile::read_box(const glm::i64vec3& low, const glm::i64vec3& high) const {
  Volume box = empty_box(header_, low, high);
  const std::uint64_t size = sample_type_bytes(header_.type());
  const Extents& n = header_.extents;
  const std::uint64_t row_bytes = std::uint64_t(box.extents.x) * size, pitch = std::uint64_t(n.x) * size;
  const std::uint64_t rows = std::uint64_t(box.extents.y);
  std::byte* to = std::visit([](auto& samples) { return reinterpret_cast<std::byte*>(samples.data()); }, box.samples);
  std::vector<std::byte> scratch;
  for (std::int64_t coset = 0; coset < coset_count(box.lattice); ++coset)
    for (std::int64_t k = low.z; k < high.z; ++k, to += rows * row_bytes) {
      const std::uint64_t first = std::uint64_t(((coset * n.z + k) * n.y + low.y) * n.x + low.x);
      read_rows(*samples_, begin_ + first * size, rows, row_bytes, pitch, to, scratch);
    }
  if (swap_bytes_) swap_sample_bytes(box.samples);
  return box;
}

}  // namespace quincunx

#include "tests/io/sparse_volume.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

namespace quincunx {
namespace {

std::string header_text(LatticeKind lattice, const Extents& n, SampleType type) {
  constexpr std::array<std::string_view, 4> types{"uint8", "int16", "uint16", "float"};
  const bool bcc = lattice == LatticeKind::bcc;
  const int step = lattice_step(lattice);
  return fmt::format("NRRD0004\ntype: {}\ndimension: {}\nspace dimension: 3\nsizes: {} {} {}{}\n"
                     "space directions: ({},0,0) (0,{},0) (0,0,{}){}\nendian: little\nencoding: raw\nlattice:={}\n\n",
                     types[std::size_t(type)], bcc ? 4 : 3, n.x, n.y, n.z, bcc ? " 2" : "", step, step, step, bcc ? " none" : "",
                     lattice_name(lattice));
}

void write_at(int descriptor, const void* from, std::size_t bytes, std::uint64_t position) {
  if (::pwrite(descriptor, from, bytes, off_t(position)) != ssize_t(bytes))
    throw std::system_error(errno, std::generic_category(), "sparse volume");
}

template <class T>
void convert(double value, std::byte* to) {
  const T sample = T(value);
  std::memcpy(to, &sample, sizeof sample);
}

}  // namespace

SparseVolume::SparseVolume(LatticeKind lattice, const Extents& extents, SampleType type, const std::string& path)
    : lattice_(lattice), extents_(extents), type_(type) {
  const std::string text = header_text(lattice, extents, type);
  begin_ = text.size();
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), path);
  write_at(descriptor_, text.data(), text.size(), 0);
  const std::uint64_t samples = std::uint64_t(coset_count(lattice) * extents.x * extents.y * extents.z);
  if (::ftruncate(descriptor_, off_t(begin_ + samples * sample_type_bytes(type))) != 0)
    throw std::system_error(errno, std::generic_category(), path);
}

SparseVolume::~SparseVolume() { ::close(descriptor_); }

void SparseVolume::put(const glm::i64vec3& low, const glm::i64vec3& high, const std::function<double(const glm::dvec3& u)>& value) {
  constexpr std::array conversions{convert<std::uint8_t>, convert<std::int16_t>, convert<std::uint16_t>, convert<float>};
  const std::size_t size = sample_type_bytes(type_);
  std::vector<std::byte> row(std::size_t(high.x - low.x) * size);
  for (std::int64_t coset = 0; coset < coset_count(lattice_); ++coset)
    for (std::int64_t k = low.z; k < high.z; ++k)
      for (std::int64_t j = low.y; j < high.y; ++j) {
        for (std::int64_t i = low.x; i < high.x; ++i) {
          const glm::dvec3 u(std::int64_t(lattice_step(lattice_)) * glm::i64vec3(i, j, k) + coset);
          conversions[std::size_t(type_)](value(u), row.data() + std::size_t(i - low.x) * size);
        }
        const std::uint64_t first = std::uint64_t(((coset * extents_.z + k) * extents_.y + j) * extents_.x + low.x);
        write_at(descriptor_, row.data(), row.size(), begin_ + first * size);
      }
}

}  // namespace quincunx

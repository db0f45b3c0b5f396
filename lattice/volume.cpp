#include "lattice/volume.h"

#include <fmt/format.h>

#include <array>
#include <cassert>

#include "lattice/error.h"
#include "lattice/memory.h"

namespace quincunx {

std::string_view sample_type_name(SampleType type) {
  constexpr std::array<std::string_view, 4> names{"uint8", "int16", "uint16", "float32"};
  return names[std::size_t(type)];
}

std::size_t sample_type_bytes(SampleType type) {
  constexpr std::array<std::size_t, 4> bytes{1, 2, 2, 4};
  return bytes[std::size_t(type)];
}

std::size_t Volume::sample_count() const {
  return std::size_t(coset_count(lattice)) * std::size_t(extents.x) * std::size_t(extents.y) * std::size_t(extents.z);
}

double Volume::sample(int coset, const glm::i64vec3& index) const {
  assert(coset >= 0 && coset < coset_count(lattice));
  assert(index.x >= 0 && index.x < extents.x && index.y >= 0 && index.y < extents.y && index.z >= 0 &&
         index.z < extents.z);
  const std::int64_t number = ((coset * extents.z + index.z) * extents.y + index.y) * extents.x + index.x;
  return std::visit([&](const auto& s) { return double(s[std::size_t(number)]); }, samples);
}

void check_finite(const SampleRange& range, const Volume& volume, std::string_view what) {
  if (range.not_finite == 0) return;
  const auto n = std::int64_t(range.first_not_finite);
  const Extents& e = volume.extents;
  const std::string coset = volume.lattice == LatticeKind::bcc ? fmt::format("coset {}, ", n / (e.x * e.y * e.z)) : "";
  throw InputError(fmt::format("{}: found {} NaN or infinite of {} samples, the first at {}index ({}, {}, {}); expected finite samples",
                               what, range.not_finite, volume.sample_count(), coset, n % e.x, n / e.x % e.y, n / (e.x * e.y) % e.z));
}

void check_volume(const Volume& volume, std::string_view what) {
  const std::uint64_t expected = checked_sample_count(volume.lattice, volume.extents, volume.type(), what);
  const std::size_t found = std::visit([](const auto& s) { return s.size(); }, volume.samples);
  if (found == expected) return;
  throw InputError(fmt::format("{}: {} samples, expected {} for {} extents {} x {} x {}", what, found, expected,
                               lattice_name(volume.lattice), volume.extents.x, volume.extents.y, volume.extents.z));
}

}  // namespace quincunx

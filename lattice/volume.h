// Samples on a lattice in the world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "lattice/lattice.h"

namespace quincunx {

/// The types a sample may have. The order is that of Volume::Samples' alternatives.
enum class SampleType { uint8, int16, uint16, float32 };

std::string_view sample_type_name(SampleType type);
std::size_t sample_type_bytes(SampleType type);

/// A sampled volume.
///
/// Samples lie x fastest, then y, z, and the coset slowest: sample (c; i,j,k) is number
/// ((c*nz + k)*ny + j)*nx + i, and there are coset_count * nx*ny*nz of them.
struct Volume {
  using Samples = std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>,
                               std::vector<std::uint16_t>, std::vector<float>>;

  LatticeKind lattice = LatticeKind::cartesian;
  Extents extents{0};
  World world;
  Samples samples;
  /// Key/value pairs that travel with the file (provenance, licence, ...), in file order.
  std::vector<std::pair<std::string, std::string>> notes;

  SampleType type() const { return static_cast<SampleType>(samples.index()); }
  std::size_t sample_count() const;
  /// Sample (coset; index) as a double; indices are in range (asserted).
  double sample(int coset, const glm::i64vec3& index) const;
};

/// Smallest and largest sample, and how many are NaN or infinite (float32 only) with the number of the first such.
/// min and max are over the finite samples; 0 and 0 where there is none.
struct SampleRange {
  double min = 0.0, max = 0.0;
  std::size_t not_finite = 0, first_not_finite = 0;
};
SampleRange sample_range(const Volume& volume);

/// Throws InputError "WHAT: found ..." with their count and the place of the first, where `range`, of the volume's samples, has any that
/// are not finite. The volume's own samples are not looked at.
void check_finite(const SampleRange& range, const Volume& volume, std::string_view what);

/// The samples' quantiles at `fractions` (each 0..1), exact order statistics of the finite samples.
std::vector<double> sample_quantiles(const Volume& volume, std::span<const double> fractions);

/// Throws InputError unless every extent is at least 1 and the samples are as many as they say.
void check_volume(const Volume& volume, std::string_view what);

}  // namespace quincunx

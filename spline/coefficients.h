// Coefficients of a spline: what the prefilter makes of a volume's samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice/lattice.h"
#include "spline/value_unit.h"

namespace quincunx {

/// How many numbers the coefficients of a volume are, with an apron of so many samples on every side.
inline std::uint64_t coefficient_count(LatticeKind lattice, const Extents& extents, int apron) {
  const glm::i64vec3 padded = extents + std::int64_t(2 * apron);
  return std::uint64_t(coset_count(lattice)) * std::uint64_t(padded.x) * std::uint64_t(padded.y) * std::uint64_t(padded.z);
}

/// Spline coefficients on a lattice, padded on every side of every coset by `apron` samples that repeat the
/// border (each index of each coset clamped), so that no evaluation inside the domain needs to clamp.
/// T is double (the reference) or float (what the kernels read).
template <class T>
struct Coefficients {
  LatticeKind lattice = LatticeKind::bcc;
  Extents extents{0};  ///< without the apron
  int apron = 0;
  World world;
  std::vector<T> data;  ///< number ((c*pz + k+apron)*py + j+apron)*px + i+apron, p = extents + 2*apron
  ValueUnit unit;       ///< of `data`; plain for the reference

  Extents padded() const { return extents + std::int64_t(2 * apron); }
  std::int64_t stride_y() const { return padded().x; }
  std::int64_t stride_z() const { return padded().x * padded().y; }
  std::int64_t stride_coset() const { return padded().x * padded().y * padded().z; }
  /// Number in `data` of (coset; index), each index in [-apron, extent + apron).
  std::size_t number(int coset, const glm::i64vec3& index) const {
    const glm::i64vec3 p = index + std::int64_t(apron);
    return std::size_t(coset * stride_coset() + p.z * stride_z() + p.y * stride_y() + p.x);
  }
};

/// Those of the reference as kernels of 32-bit floats read them: what coefficients_float makes.
inline Coefficients<float> narrowed(const Coefficients<double>& c) {
  return {c.lattice, c.extents, c.apron, c.world, std::vector<float>(c.data.begin(), c.data.end()), c.unit};
}

}  // namespace quincunx

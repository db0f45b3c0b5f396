// Volumes larger than memory, written in no time.
#pragma once

#include <functional>
#include <string>

#include "lattice/volume.h"

namespace quincunx {

/// A raw NRRD file that is mostly a hole, read as zeros: only what is put into it takes room on the disk. The world is the lattice's own.
class SparseVolume {
 public:
  /// Writes the header and makes the file as long as it says. Throws std::system_error.
  SparseVolume(LatticeKind lattice, const Extents& extents, SampleType type, const std::string& path);
  ~SparseVolume();
  SparseVolume(const SparseVolume&) = delete;
  SparseVolume& operator=(const SparseVolume&) = delete;

  /// Writes the samples low <= index < high of every coset; value(u) is of lattice coordinates and converted to the type.
  void put(const glm::i64vec3& low, const glm::i64vec3& high, const std::function<double(const glm::dvec3& u)>& value);

 private:
  LatticeKind lattice_;
  Extents extents_;
  SampleType type_;
  int descriptor_ = -1;
  std::uint64_t begin_ = 0;  ///< of the samples
};

}  // namespace quincunx

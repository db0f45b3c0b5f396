// Samples that are read box by box: a volume that need not be in memory.
#pragma once

#include <cstdint>

#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// Where the samples of one volume come from, in memory or not. All functions may be called from several threads at once.
class SampleSource {
 public:
  virtual ~SampleSource() = default;

  /// The volume without its samples: lattice, extents, world, notes; `samples` is empty but of their type.
  virtual const Volume& header() const = 0;

  /// The samples low <= index < high of every coset, as a volume of its own in its place in the world, without notes.
  /// The box is inside the extents and not empty (asserted). Throws InputError where they cannot be read.
  virtual Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const = 0;
};

/// A volume in memory as a source. Keeps a reference.
class VolumeSource final : public SampleSource {
 public:
  explicit VolumeSource(const Volume& volume);

  const Volume& header() const override { return header_; }
  Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const override;

 private:
  const Volume& volume_;
  Volume header_;
};

/// What read_box returns, its samples still to be written: as many as the box has, of the header's type.
Volume empty_box(const Volume& header, const glm::i64vec3& low, const glm::i64vec3& high);

/// The range of all samples, in one parallel pass over boxes of about a million; first_not_finite is a number in the whole volume.
SampleRange sample_range(const SampleSource& source, const Progress& progress = {});

}  // namespace quincunx

// Samples that are NaN or infinite, and what is made of them.
#pragma once

#include <memory>

#include "lattice/sample_source.h"
#include "lattice/volume.h"

namespace quincunx {

/// What becomes of a volume's samples that are NaN or infinite. Integers never are.
struct NanPolicy {
  enum class Kind {
    refuse,  ///< they are an error
    empty,   ///< nothing is seen where they have a weight (accel/void_cells.h)
    fill,    ///< each of them is taken as `value`
  };
  Kind kind = Kind::refuse;
  double value = 0.0;  ///< of fill; finite as a float

  bool operator==(const NanPolicy&) const = default;
};

/// Whether samples of this volume's type can be NaN or infinite.
bool may_not_be_finite(const Volume& volume);

/// Replaces every sample that is not finite by `value`, rounded to a float.
void fill_not_finite(Volume& volume, double value);

/// The same of samples that are read box by box.
std::shared_ptr<const SampleSource> filled_source(std::shared_ptr<const SampleSource> source, double value);

/// Replaces every sample that is not finite by an extension of the finite ones about it, so that a prefilter, which reaches no farther than
/// a sample's neighbours, makes of the samples beside a gap what it makes of smooth ones. Linear functions are extended as such:
/// along every direction from neighbour to neighbour (14 of the BCC lattice, 26 of the Cartesian one) in which the next two samples a, b are finite, the
/// extension is 2a - b, and the sample becomes the mean of these; where there is no such direction, the mean of its finite neighbours; where no
/// neighbour is finite, the middle of the range of all finite samples (0 where there is none).
void extend_finite(Volume& volume);

}  // namespace quincunx

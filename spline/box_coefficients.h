// The coefficients of a part of a volume, bit for bit those of the whole.
#pragma once

#include <span>

#include "lattice/sample_source.h"
#include "spline/spline.h"

namespace quincunx {

/// Indices first <= index < first + size of every coset, which may reach beyond the volume.
struct IndexBox {
  glm::i64vec3 first{0};
  Extents size{0};
};

/// Writes the coefficients of `box`, in `unit`, to `out`, which has one number for each, x fastest, coset slowest; each index is clamped to the volume.
/// The samples they depend on are read and prefiltered, nothing else. The samples are supposed to be finite (sample_range tells).
void box_coefficients(const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, const ValueUnit& unit, const IndexBox& box,
                      std::span<float> out);

/// The same, copied from the coefficients of the whole volume.
void copy_box(const Coefficients<float>& whole, const IndexBox& box, std::span<float> out);

}  // namespace quincunx

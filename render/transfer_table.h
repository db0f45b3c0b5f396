// Transfer functions as the kernel looks them up.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/transfer_function.h"

namespace quincunx {

/// Post-classification: what one sample adds, by its value. Entry n of N is that of the value low + n (high - low) / (N - 1);
/// between entries it is interpolated, before the first and after the last it is constant.
///
/// An entry is (alpha' r, alpha' g, alpha' b, alpha'), alpha' = 1 - exp(-tau length) the opacity of a sample's stretch;
/// tau = -ln(max(1 - opacity, 2^-24)) / unit. Where the opacity is 0 it is exactly 0.
struct TransferTable {
  float low = 0.0f, high = 1.0f;
  std::vector<glm::vec4> entries;
};

/// Bakes a checked function. `entries` >= 2; `length` of a sample's stretch and `unit`, which counts where the function's is 0, in
/// world units, above 0. The table ends at the function's first and last value, rounded away from each other to 32 bits.
/// Throws InputError naming --tf-entries where values with opacity lie so close together that no entry is among them.
TransferTable bake(const TransferFunction& function, int entries, double length, double unit);

/// Pre-integrated classification: what a stretch of `length` adds along which the value goes linearly from `front` to `back`, by both
/// values. K. Engel, M. Kraus, T. Ertl, *High-quality pre-integrated volume rendering using hardware-accelerated pixel shading*, 2001,
/// DOI 10.1145/383507.383515; attenuation within the stretch counts in the colours too.
///
/// Cell [back * entries + front] is that of two values placed as in a TransferTable: (premultiplied r, g, b, alpha).
struct PreIntegratedTable {
  float low = 0.0f, high = 1.0f;
  int entries = 0;
  std::vector<glm::vec4> cells;
};

/// Integrates a checked function; the parameters are those of bake. Takes 16 bytes a cell. Alpha is exact but for rounding, colours
/// are to within 1e-6; cells between whose values no opacity lies are exactly 0, and a stretch of values however narrow is met.
PreIntegratedTable pre_integrate(const TransferFunction& function, int entries, double length, double unit);

/// The largest float not above x and the smallest not below, for |x| <= 1e37. A table's ends: an end moved inwards would lie where
/// the function already has opacity, and with it every value beyond.
float float_below(double x);
float float_above(double x);

}  // namespace quincunx

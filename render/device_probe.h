// What kernels compute, taken out of them: the spline at points, and first roots of polynomials.
#pragma once

#include <span>
#include <vector>

#include "gpu/gpu.h"
#include "spline/spline.h"

namespace quincunx {

/// The spline of `coefficients` and its gradient at `points` (lattice coordinates inside the domain, rounded to floats relative to its
/// centre: `points` becomes what they are then), computed on the device in 32-bit floats as a difference to `reference`, in the coefficients' own unit. The coefficients
/// fit one buffer of the device. Throws as gpu::create_buffer does.
std::vector<Jet> probe_spline(gpu::Device& device, const Spline& spline, const Coefficients<float>& coefficients, double reference,
                              std::span<glm::dvec3> points);

/// The first root in [0,1] of each polynomial, or a negative number. `bernstein`: degree + 1 coefficients each, the first one positive.
/// `degree`: that of a spline along a ray.
std::vector<float> probe_roots(gpu::Device& device, int degree, std::span<const float> bernstein);

}  // namespace quincunx

// The parameters of the kernel for one picture, prepared in double precision.
#pragma once

#include "render/scene.h"
#include "shaders/shared/trace_parameters.h"
#include "spline/coefficients.h"

namespace quincunx {

/// Everything about volume and picture; `picture` for the whole picture, `blocks` and `bricks` left 0.
///
/// Rays start at a point near the volume instead of at the eye (the place where the pixel's direction meets the plane through the
/// domain's centre), relative to the centre, so that 32-bit floats hold them however far the eye is.
/// Throws InputError where the world's axes do not span space.
TraceParameters trace_parameters(const Scene& scene, const Coefficients<float>& coefficients);

}  // namespace quincunx

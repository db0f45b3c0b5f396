// The tricubic B-spline on the Cartesian lattice (twin of spline/tricubic.h), 32-bit floats.
const real SPLINE_SCALE = 216.0;
#include "cartesian.glsl"
#include "one_piece.glsl"
#include "tensor_cubic.glsl"
#include "cubic_b_spline.glsl"

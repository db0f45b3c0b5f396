// The first root of a polynomial in Bernstein form on [0,1], of the spline's degree.
#if SPLINE_DEGREE == 4
#include "bernstein_4.glsl"
#else
#include "bernstein_n.glsl"
#endif

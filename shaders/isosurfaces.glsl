// The isovalues, ascending, with colour and opacity.
//
// A place's level is the number of isovalues at or below the value there. Along the ray only two surfaces can be
// crossed from level L: upwards the isovalue L, downwards the isovalue L - 1.
const int LEVEL_UNKNOWN = -1;  // before a ray's first value

layout(std430, binding = 2) readonly buffer Isosurfaces {
  vec4 isosurface[];  // 2k: isovalue, opacity, the isovalue as a double in two words; 2k + 1: colour
};

// Kernels compute SPLINE_SCALE times the spline's values.
#ifdef DOUBLE
real scaled_isovalue(int k) { return SPLINE_SCALE * packDouble2x32(floatBitsToUint(isosurface[2 * k].zw)); }
#else
real scaled_isovalue(int k) { return SPLINE_SCALE * isosurface[2 * k].x; }
#endif

#if ISOVALUES == 1
int level_of(real value) { return value >= scaled_isovalue(0) ? 1 : 0; }
#else
int count_isovalues(real value) {
  int count = 0;
  for (int k = 0; k < parameters.cells.w; ++k) count += value >= scaled_isovalue(k) ? 1 : 0;
  return count;
}
int level_of(real value) { return count_isovalues(value); }
#endif

// The spline's coefficients by their number, from one texel buffer or, where the device limits its elements, several
// (COEFFICIENT_BUFFERS of 2^COEFFICIENT_SHIFT elements each).
layout(binding = 1) uniform samplerBuffer coefficients0;
#if COEFFICIENT_BUFFERS > 1
layout(binding = 11) uniform samplerBuffer coefficients1;
#endif
#if COEFFICIENT_BUFFERS > 2
layout(binding = 12) uniform samplerBuffer coefficients2;
#endif
#if COEFFICIENT_BUFFERS > 3
layout(binding = 13) uniform samplerBuffer coefficients3;
#endif
#if COEFFICIENT_BUFFERS > 4
layout(binding = 14) uniform samplerBuffer coefficients4;
#endif
#if COEFFICIENT_BUFFERS > 5
layout(binding = 15) uniform samplerBuffer coefficients5;
#endif
#if COEFFICIENT_BUFFERS > 6
layout(binding = 16) uniform samplerBuffer coefficients6;
#endif
#if COEFFICIENT_BUFFERS > 7
layout(binding = 17) uniform samplerBuffer coefficients7;
#endif

real coefficient(int number) {
#if COEFFICIENT_BUFFERS == 1
  return texelFetch(coefficients0, number).r;
#else
  int buffer_number = number >> COEFFICIENT_SHIFT;
  int element = number & ((1 << COEFFICIENT_SHIFT) - 1);
  real c = texelFetch(coefficients0, element).r;
  c = buffer_number == 1 ? texelFetch(coefficients1, element).r : c;
#if COEFFICIENT_BUFFERS > 2
  c = buffer_number == 2 ? texelFetch(coefficients2, element).r : c;
#endif
#if COEFFICIENT_BUFFERS > 3
  c = buffer_number == 3 ? texelFetch(coefficients3, element).r : c;
#endif
#if COEFFICIENT_BUFFERS > 4
  c = buffer_number == 4 ? texelFetch(coefficients4, element).r : c;
#endif
#if COEFFICIENT_BUFFERS > 5
  c = buffer_number == 5 ? texelFetch(coefficients5, element).r : c;
#endif
#if COEFFICIENT_BUFFERS > 6
  c = buffer_number == 6 ? texelFetch(coefficients6, element).r : c;
#endif
#if COEFFICIENT_BUFFERS > 7
  c = buffer_number == 7 ? texelFetch(coefficients7, element).r : c;
#endif
  return c;
#endif
}

// Number of the coefficient (coset 0; 0,0,0), as an evaluation in `cell` counts: (coset; i,j,k) has the number
// origin + coset strides.z + i + j strides.x + k strides.y.
#ifdef BRICKS
#include "bricks.glsl"
#else
int coefficient_origin(ivec3 cell) { return parameters.strides.w; }
#endif

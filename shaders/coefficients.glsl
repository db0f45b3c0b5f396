// The spline's coefficients by their number, from one texel buffer or, where the device limits its elements, several
// (COEFFICIENT_BUFFERS of 2^COEFFICIENT_SHIFT elements each). A double is an element of two words; of numbers of 16 and 8 bits (spline/storage.h) a
// fetch makes floats.
#ifdef DOUBLE
#define COEFFICIENTS usamplerBuffer
#define FETCH_COEFFICIENT(buffer, element) packDouble2x32(texelFetch(buffer, element).rg)
#else
#define COEFFICIENTS samplerBuffer
#define FETCH_COEFFICIENT(buffer, element) texelFetch(buffer, element).r
#endif
layout(binding = 1) uniform COEFFICIENTS coefficients0;
#if COEFFICIENT_BUFFERS > 1
layout(binding = 11) uniform COEFFICIENTS coefficients1;
#endif
#if COEFFICIENT_BUFFERS > 2
layout(binding = 12) uniform COEFFICIENTS coefficients2;
#endif
#if COEFFICIENT_BUFFERS > 3
layout(binding = 13) uniform COEFFICIENTS coefficients3;
#endif
#if COEFFICIENT_BUFFERS > 4
layout(binding = 14) uniform COEFFICIENTS coefficients4;
#endif
#if COEFFICIENT_BUFFERS > 5
layout(binding = 15) uniform COEFFICIENTS coefficients5;
#endif
#if COEFFICIENT_BUFFERS > 6
layout(binding = 16) uniform COEFFICIENTS coefficients6;
#endif
#if COEFFICIENT_BUFFERS > 7
layout(binding = 17) uniform COEFFICIENTS coefficients7;
#endif

#ifdef BRICK_UNITS
vec2 brick_unit;  // offset and scale of the numbers of the brick that was last asked for its coefficient_origin
real in_unit(real number) {
  precise real value = brick_unit.x + brick_unit.y * number;
  return value;
}
#else
#define in_unit(number) (number)
#endif

#ifdef BRICKS
bool brick_here = false;  // whether the brick that was last asked for its coefficient_origin is resident; where it is not, anything is read
#endif

real coefficient(int number) {
#ifdef BRICKS
  number = brick_here ? number : 0;
#endif
#if COEFFICIENT_BUFFERS == 1
  return in_unit(FETCH_COEFFICIENT(coefficients0, number));
#else
  int buffer_number = number >> COEFFICIENT_SHIFT;
  int element = number & ((1 << COEFFICIENT_SHIFT) - 1);
  real c = FETCH_COEFFICIENT(coefficients0, element);
  c = buffer_number == 1 ? FETCH_COEFFICIENT(coefficients1, buffer_number == 1 ? element : 0) : c;
#if COEFFICIENT_BUFFERS > 2
  c = buffer_number == 2 ? FETCH_COEFFICIENT(coefficients2, buffer_number == 2 ? element : 0) : c;
#endif
#if COEFFICIENT_BUFFERS > 3
  c = buffer_number == 3 ? FETCH_COEFFICIENT(coefficients3, buffer_number == 3 ? element : 0) : c;
#endif
#if COEFFICIENT_BUFFERS > 4
  c = buffer_number == 4 ? FETCH_COEFFICIENT(coefficients4, buffer_number == 4 ? element : 0) : c;
#endif
#if COEFFICIENT_BUFFERS > 5
  c = buffer_number == 5 ? FETCH_COEFFICIENT(coefficients5, buffer_number == 5 ? element : 0) : c;
#endif
#if COEFFICIENT_BUFFERS > 6
  c = buffer_number == 6 ? FETCH_COEFFICIENT(coefficients6, buffer_number == 6 ? element : 0) : c;
#endif
#if COEFFICIENT_BUFFERS > 7
  c = buffer_number == 7 ? FETCH_COEFFICIENT(coefficients7, buffer_number == 7 ? element : 0) : c;
#endif
  return in_unit(c);
#endif
}

// Number of the coefficient (coset 0; 0,0,0), as an evaluation in `cell` counts: (coset; i,j,k) has the number
// origin + coset strides.z + i + j strides.x + k strides.y.
#ifdef BRICKS
#include "bricks.glsl"
#else
int coefficient_origin(ivec3 cell) { return parameters.strides.w; }
#endif

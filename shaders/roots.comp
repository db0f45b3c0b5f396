#version 460
// First roots of polynomials in Bernstein form, as kernels find them.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Polynomials {
  float coefficient[];  // SPLINE_DEGREE + 1 a polynomial, the first one positive
};
layout(std430, binding = 1) writeonly buffer Roots {
  float root[];  // in [0,1], or negative where there is none
};
#include "real.glsl"
#include "bernstein.glsl"

void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n >= root.length()) return;
  float b[SPLINE_DEGREE + 1];
  for (int i = 0; i <= SPLINE_DEGREE; ++i) b[i] = coefficient[(SPLINE_DEGREE + 1) * n + i];
  root[n] = first_root(b);
}

#version 460
// The spline at points: what kernels compute of it, to be compared with the double-precision class.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "real.glsl"
#include "shared/trace_parameters.h"
#include "coefficients.glsl"
#include "spline.glsl"

layout(std430, binding = 20) readonly buffer Points {
  vec4 points[];  // lattice coordinates relative to the domain's centre
};
layout(std430, binding = 21) writeonly buffer Jets {
  vec4 jets[];  // gradient of lattice coordinates and value less the offset, all SPLINE_SCALE times the spline's
};

void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n >= points.length()) return;
  vec3 centre = 0.5 * vec3(parameters.cells.xyz);
  vec3 p = points[n].xyz;
  ivec3 at = clamp(ivec3(floor(p + centre)), ivec3(0), parameters.cells.xyz - 1);
  SplineCell cell = spline_cell(at, centre);
  float value;
  vec3 gradient;
  spline_jet(cell, cell_point(cell, p, vec3(0.0), 0.0), SPLINE_SCALE * parameters.march.x, value, gradient);
  jets[n] = vec4(gradient, value) / SPLINE_SCALE;
}

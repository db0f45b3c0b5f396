// Where the results of the lanes' pixels go.
#include "lane_pixel.glsl"

layout(std430, binding = 5) writeonly buffer Color {
  vec4 color[];  // R G B A
};
layout(std430, binding = 6) writeonly buffer Hit {
  vec4 hit[];  // N.X N.Y N.Z Z
};
#ifdef COST
layout(std430, binding = 7) buffer Cost {
  vec4 cost[];  // evaluations, steps, intervals, 0
};
#endif

const real NO_HIT = 1.0 / 0.0;

void write_pixel(ivec2 pixel, rvec4 rgba, rvec4 normal_and_depth) {
  int p = pixel_number(pixel);
  color[p] = narrow(rgba);
  hit[p] = narrow(normal_and_depth);
}

#ifdef COST
rvec3 read_cost(ivec2 pixel) { return cost[pixel_number(pixel)].xyz; }
void write_cost(ivec2 pixel, rvec3 counts) { cost[pixel_number(pixel)] = vec4(counts, 0.0); }
#endif

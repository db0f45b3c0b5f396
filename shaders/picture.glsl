// Where the lanes' pixels are and where their results go.
//
// Groups of 64 lanes are 8x8 pixels; within them each 8 lanes are 4x2 pixels, the shape that keeps neighbours together on 8-lane devices.
layout(local_size_x = 64) in;

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

// The pixel of this lane, row 0 at the top of the picture.
ivec2 lane_pixel() {
  int lane = int(gl_LocalInvocationIndex);
  ivec2 in_quad = ivec2(lane & 3, (lane >> 2) & 1);
  ivec2 quad = ivec2((lane >> 3) & 1, lane >> 4);
  return ivec2(gl_WorkGroupID.xy) * 8 + quad * ivec2(4, 2) + in_quad + ivec2(0, parameters.picture.z);
}
bool in_picture(ivec2 pixel) { return pixel.x < parameters.picture.x && pixel.y < min(parameters.picture.y, parameters.picture.z + parameters.picture.w); }
int pixel_number(ivec2 pixel) { return (pixel.y - parameters.picture.z) * parameters.picture.x + pixel.x; }

void write_pixel(ivec2 pixel, rvec4 rgba, rvec4 normal_and_depth) {
  int p = pixel_number(pixel);
  color[p] = narrow(rgba);
  hit[p] = narrow(normal_and_depth);
}

#ifdef COST
rvec3 read_cost(ivec2 pixel) { return cost[pixel_number(pixel)].xyz; }
void write_cost(ivec2 pixel, rvec3 counts) { cost[pixel_number(pixel)] = vec4(counts, 0.0); }
#endif

// Groups of 64 lanes are 8x8 pixels; within them each 8 lanes are 4x2 pixels, the shape that keeps neighbours together on 8-lane devices.
layout(local_size_x = 64) in;

// The pixel of this lane, row 0 at the top of the picture.
ivec2 lane_pixel() {
  int lane = int(gl_LocalInvocationIndex);
  ivec2 in_quad = ivec2(lane & 3, (lane >> 2) & 1);
  ivec2 quad = ivec2((lane >> 3) & 1, lane >> 4);
  return ivec2(gl_WorkGroupID.xy) * 8 + quad * ivec2(4, 2) + in_quad + ivec2(0, parameters.picture.z);
}
bool in_picture(ivec2 pixel) { return pixel.x < parameters.picture.x && pixel.y < min(parameters.picture.y, parameters.picture.z + parameters.picture.w); }

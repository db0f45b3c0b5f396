// The uniform grid (accel/grid.h), walked block by block.
#include "skip_block.glsl"

layout(binding = 3) uniform usamplerBuffer gridLevel;

const uint GRID_ACTIVE = 255u;

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  int shift = parameters.blocks.w;
  ivec3 block = cell >> shift;
  uint level = texelFetch(gridLevel, block_number(block)).r;
  until = exit_time(ray, block << shift, 1 << shift);
  from = level == GRID_ACTIVE ? t : until;
  return asked;
}

// The distance map (accel/distance.h): one fetch leaps over the largest cube of empty blocks around the ray's block.
#include "skip_block.glsl"

layout(binding = 3) uniform usamplerBuffer blockDistance;

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  int shift = parameters.blocks.w;
  ivec3 block = cell >> shift;
  int empty = int(texelFetch(blockDistance, block_number(block)).r);
  int radius = max(empty - 1, 0);
  until = exit_time(ray, (block - radius) << shift, (2 * radius + 1) << shift);
  from = empty == 0 ? t : until;
  return asked;
}

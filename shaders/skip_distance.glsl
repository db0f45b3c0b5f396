// The distance map (accel/distance.h): one fetch leaps over the largest cube of empty blocks around the ray's block.
layout(binding = 3) uniform usamplerBuffer blockDistance;

struct SkipState {
  int unused;
};
SkipState begin_skip() { return SkipState(0); }

bool skip_step(Ray ray, ivec3 cell, float t, bool asked, inout SkipState state, out float from, out float until) {
  int shift = parameters.blocks.w;
  ivec3 block = cell >> shift;
  int empty = int(texelFetch(blockDistance, (block.z * parameters.blocks.y + block.y) * parameters.blocks.x + block.x).r);
  int radius = max(empty - 1, 0);
  until = exit_time(ray, (block - radius) << shift, (2 * radius + 1) << shift);
  from = empty == 0 ? t : until;
  return asked;
}

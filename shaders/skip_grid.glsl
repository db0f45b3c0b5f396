// The uniform grid (accel/grid.h), walked block by block.
layout(binding = 3) uniform usamplerBuffer gridLevel;

const uint GRID_ACTIVE = 255u;

struct SkipState {
  int unused;
};
SkipState begin_skip() { return SkipState(0); }

bool skip_step(Ray ray, ivec3 cell, float t, bool asked, inout SkipState state, out float from, out float until) {
  int shift = parameters.blocks.w;
  ivec3 block = cell >> shift;
  uint level = texelFetch(gridLevel, (block.z * parameters.blocks.y + block.y) * parameters.blocks.x + block.x).r;
  until = exit_time(ray, block << shift, 1 << shift);
  from = level == GRID_ACTIVE ? t : until;
  return asked;
}

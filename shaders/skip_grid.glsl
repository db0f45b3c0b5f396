// The uniform grid (accel/grid.h), walked block by block.
layout(binding = 3) uniform usamplerBuffer gridLevel;

const uint GRID_ACTIVE = 255u;

bool skip_probe(Ray ray, ivec3 cell, float t, inout int level, out float until) {
  int shift = parameters.blocks.w;
  ivec3 block = cell >> shift;
  uint found = texelFetch(gridLevel, (block.z * parameters.blocks.y + block.y) * parameters.blocks.x + block.x).r;
  until = exit_time(ray, block << shift, 1 << shift);
  bool matters = found == GRID_ACTIVE;
  level = matters ? level : int(found);
  return matters;
}

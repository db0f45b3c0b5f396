// The uniform grid (accel/grid.h), walked block by block.
layout(constant_id = 0) const int BLOCK_SHIFT = 4;  // log2 of the block's edge in cells
layout(binding = 3) uniform usamplerBuffer gridLevel;

const uint GRID_ACTIVE = 255u;

bool skip_probe(Ray ray, ivec3 cell, float t, inout int level, out float until) {
  ivec3 block = cell >> BLOCK_SHIFT;
  uint found = texelFetch(gridLevel, (block.z * parameters.blocks.y + block.y) * parameters.blocks.x + block.x).r;
  ivec3 low = block << BLOCK_SHIFT;
  until = exit_time(ray, low, min(low + (1 << BLOCK_SHIFT), parameters.cells.xyz));
  bool matters = found == GRID_ACTIVE;
  level = matters ? level : int(found);
  return matters;
}

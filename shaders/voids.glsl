// Void cells: those in which a sample that is not finite has a weight (accel/void_cells.h). Nothing is seen in them. One bit a cell, in
// bricks laid out as those of the cell test (walk.glsl).
layout(binding = 10) uniform usamplerBuffer voids;

bool is_void(ivec3 cell) {
  ivec3 brick = cell >> 2;
  uvec2 words = texelFetch(voids, (brick.z * parameters.bricks.y + brick.y) * parameters.bricks.x + brick.x).rg;
  ivec3 r = cell & ivec3(3, 3, 1);
  return ((((cell.z & 2) != 0 ? words.y : words.x) >> (r.z * 16 + r.y * 4 + r.x)) & 1u) != 0u;
}

#if defined(MARCH) || defined(PRE_INTEGRATED)
// Where `wanted`, whether a cell that the ray is in between a and b is void.
bool void_between(Ray ray, real a, real b, bool wanted) {
  bool met = false;
  bool walking = wanted;
  ivec3 cell = cell_at(ray, a);
  real t = a;
  do {
    met = met || (walking && is_void(cell));
    real leave = exit_time(ray, cell, 1);
    ivec3 next = next_cell(ray, cell, leave);
    // At the domain's border a cell may be its own next one.
    walking = walking && !met && leave < b && leave > t;
    t = walking ? leave : t;
    cell = walking ? next : cell;
  } while (subgroupAny(walking));
  return met;
}
#endif

// The walk over the cells that may matter, in the order of the ray.
#include "skip.glsl"

const int LEVEL_UNKNOWN = -1;

struct Walk {
  ivec3 cell;   // to look at next
  float t;      // where the ray enters it
  float until;  // how far the structure's last answer reaches
  bool matters;  // that answer
  int level;    // of the ray so far; LEVEL_UNKNOWN until something told
#ifdef COST
  uint steps, intervals;
#endif
};

// A walk from t on, the structure still to be asked.
Walk begin_walk(Ray ray, float t, int level) {
  Walk walk;
  walk.t = t;
  walk.cell = cell_at(ray, t);
  walk.until = t;
  walk.matters = false;
  walk.level = level;
#ifdef COST
  walk.steps = 0u;
  walk.intervals = 0u;
#endif
  return walk;
}

#ifdef CELL_TEST
// One bit per cell in bricks of 4x4x4 (accel/classification.h, CellOccupancy): x holds the planes z = 0, 1 of a brick, y z = 2, 3.
layout(binding = 4) uniform usamplerBuffer occupancy;

uvec2 occupancy_brick(ivec3 cell) {
  ivec3 brick = cell >> 2;
  return texelFetch(occupancy, (brick.z * parameters.bricks.y + brick.y) * parameters.bricks.x + brick.x).rg;
}
bool occupied(uvec2 brick, ivec3 cell) {
  ivec3 r = cell & 3;
  uint word = (r.z & 2) != 0 ? brick.y : brick.x;
  return ((word >> ((r.z & 1) * 16 + r.y * 4 + r.x)) & 1u) != 0u;
}
#endif

// Where `wanted`, moves to the next cell that may matter, from walk.cell on; false where the ray ends before one.
bool find_cell(Ray ray, inout Walk walk, bool wanted) {
#ifndef SKIP
#ifdef COST
  walk.steps += wanted ? 1u : 0u;
#endif
  return wanted && walk.t < ray.end;
#else
  bool found = false;
  bool seeking = wanted && walk.t < ray.end;
  do {
    int level = walk.level;
    float until;
    bool ask = seeking && walk.t >= walk.until;
    bool matters = skip_probe(ray, walk.cell, walk.t, level, until);
    walk.matters = ask ? matters : walk.matters;
    walk.until = ask ? until : walk.until;
    walk.level = ask && walk.level == LEVEL_UNKNOWN ? level : walk.level;
#ifdef COST
    walk.intervals += ask && matters ? 1u : 0u;
    walk.steps += seeking ? 1u : 0u;
#endif
#ifdef CELL_TEST
    uvec2 brick = occupancy_brick(walk.cell);
    found = found || (seeking && walk.matters && occupied(brick, walk.cell));
    bool whole_brick = (brick.x | brick.y) == 0u;
    ivec3 low = whole_brick ? walk.cell & ~3 : walk.cell;
    float leave = exit_time(ray, low, whole_brick ? 4 : 1);
    leave = walk.matters ? min(leave, walk.until) : walk.until;
#else
    found = found || (seeking && walk.matters);
    float leave = walk.until;
#endif
    bool step = seeking && !found;
    ivec3 next = cell_at(ray, leave);
    walk.t = step ? leave : walk.t;
    walk.cell = step ? next : walk.cell;
    seeking = step && walk.t < ray.end;
  } while (subgroupAny(seeking));
  return found;
#endif
}

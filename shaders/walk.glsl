// The walk over the cells that may matter, in the order of the ray.
#ifdef SKIP
#include "skip.glsl"
#endif

struct Walk {
  ivec3 cell;  // to look at next
  float t;     // where the ray enters it
#ifdef SKIP
  SkipState skip;
  float from, until;  // the structure's last answer
#endif
#ifdef COST
  uint steps, intervals;
#endif
};

// A walk from t on, the structure still to be asked.
Walk begin_walk(Ray ray, float t) {
  Walk walk;
  walk.t = t;
  walk.cell = cell_at(ray, t);
#ifdef SKIP
  walk.skip = begin_skip();
  walk.from = t;
  walk.until = t;
#endif
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
    bool asked = seeking && walk.t >= walk.until;
    float from, until;
    bool told = skip_step(ray, walk.cell, walk.t, asked, walk.skip, from, until);
    walk.from = told ? from : walk.from;
    walk.until = told ? until : walk.until;
    bool answered = told || (seeking && !asked);
    bool matters = answered && walk.t >= walk.from && walk.t < walk.until;
#ifdef COST
    walk.intervals += told && from < until ? 1u : 0u;
    walk.steps += seeking ? 1u : 0u;
#endif
#ifdef CELL_TEST
    uvec2 brick = occupancy_brick(walk.cell);
    found = found || (matters && occupied(brick, walk.cell));
    bool whole_brick = (brick.x | brick.y) == 0u;
    ivec3 low = whole_brick ? walk.cell & ~3 : walk.cell;
    float leave = exit_time(ray, low, whole_brick ? 4 : 1);
    leave = matters ? min(leave, walk.until) : walk.from;
#else
    found = found || matters;
    float leave = walk.from;
#endif
    bool move = answered && !found;
    ivec3 next = cell_at(ray, leave);
    walk.t = move ? leave : walk.t;
    walk.cell = move ? next : walk.cell;
    seeking = seeking && !found && walk.t < ray.end;
  } while (subgroupAny(seeking));
  return found;
#endif
}

// The walk over the cells that may matter, in the order of the ray.
#ifdef SKIP
#include "skip.glsl"
#endif

struct Walk {
  ivec3 cell;  // to look at next
  real t;      // where the ray enters it
#ifdef SKIP
  SkipState skip;
  real from, until;   // the structure's last answer
#endif
#ifdef COST
  uint steps, intervals;
#endif
};

// A walk from t on. Everything until `until` may matter; behind it the structure is to be asked.
Walk begin_walk(Ray ray, real t, real until) {
  Walk walk;
  walk.t = t;
  walk.cell = cell_at(ray, t);
#ifdef SKIP
  walk.skip = begin_skip();
  walk.from = t;
  walk.until = until;
#endif
#ifdef COST
  walk.steps = 0u;
  walk.intervals = 0u;
#endif
  return walk;
}

// How far the structure's last answer reaches.
real walk_until(Walk walk) {
#ifdef SKIP
  return walk.until;
#else
  return walk.t;
#endif
}

#ifdef CELL_TEST
// One bit per cell in bricks of 4x4x4 (accel/classification.h, CellOccupancy): x holds the planes z = 0, 1 of a brick, y z = 2, 3.
layout(binding = 4) uniform usamplerBuffer occupancy;

uvec2 occupancy_brick(ivec3 cell) {
  ivec3 brick = cell >> 2;
  return texelFetch(occupancy, (brick.z * parameters.bricks.y + brick.y) * parameters.bricks.x + brick.x).rg;
}
// The bits of the two z planes that hold the cell.
uint occupied_planes(uvec2 brick, ivec3 cell) { return (cell.z & 2) != 0 ? brick.y : brick.x; }
bool occupied(uint planes, ivec3 cell) {
  ivec3 r = cell & ivec3(3, 3, 1);
  return ((planes >> (r.z * 16 + r.y * 4 + r.x)) & 1u) != 0u;
}
// The largest empty cube around an empty cell whose edge is a power of two: 1, 2, or 4 for the whole brick.
int empty_cube(uvec2 brick, uint planes, ivec3 cell) {
  ivec3 r = cell & 2;
  bool pair = (planes & (0x00330033u << (r.y * 4 + r.x))) == 0u;
  return (brick.x | brick.y) == 0u ? 4 : pair ? 2 : 1;
}
#endif

// Where `wanted`, moves to the next cell that may matter, from walk.cell on. False where the ray ends before one, or (walk.t is
// before the end then: call again) where the walk is broken off because no more than `break_at` lanes of the subgroup still walk.
bool find_cell(Ray ray, inout Walk walk, bool wanted, uint break_at) {
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
    real from, until;
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
    uint planes = occupied_planes(brick, walk.cell);
    found = found || (matters && occupied(planes, walk.cell));
    int size = empty_cube(brick, planes, walk.cell);
    real leave = exit_time(ray, walk.cell & ~(size - 1), size);
    leave = matters ? min(leave, walk.until) : walk.from;
#else
    found = found || matters;
    real leave = walk.from;
#endif
    bool move = answered && !found;
    ivec3 next = cell_at(ray, leave);
    walk.t = move ? leave : walk.t;
    walk.cell = move ? next : walk.cell;
    seeking = seeking && !found && walk.t < ray.end;
  } while (break_at == 0u ? seeking : subgroupBallotBitCount(subgroupBallot(seeking)) > break_at);
  return found;
#endif
}

#version 460
// The tracing pass that traces nothing: rays walk to their end through everything that may matter. What it takes is
// what the structure costs.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "walk.glsl"
#include "picture.glsl"
#include "rays.glsl"

// Where `mine`, through one cell (where cells are tested) or interval after the other.
void traverse(Ray ray, inout Walk walk, bool mine) {
  bool seeking = mine;
  do {
    bool found = find_cell(ray, walk, seeking, 0u);
#if defined(CELL_TEST)
    real leave = exit_time(ray, walk.cell, 1);
#elif defined(SKIP)
    real leave = walk.until;
#else
    real leave = ray.end;
#endif
    seeking = seeking && found;
    leave = min(leave, ray.end);
    ivec3 next = cell_at(ray, leave);
    walk.t = seeking ? leave : walk.t;
    walk.cell = seeking ? next : walk.cell;
  } while (subgroupAny(seeking));
}

void main() {
  uint number = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
  bool mine = number < ray_count;
  PendingRay pending = pending_ray(mine ? number : 0u);
  Ray ray = make_ray(pending.pixel);
  Walk walk = begin_walk(ray, pending.t, pending.until);
  traverse(ray, walk, mine);
  if (mine) {
    write_pixel(pending.pixel, rvec4(parameters.background.rgb, 0.0), rvec4(0.0, 0.0, 0.0, NO_HIT));
    rvec3 before = read_cost(pending.pixel);
    write_cost(pending.pixel, before + rvec3(0.0, real(walk.steps), real(walk.intervals)));
  }
}

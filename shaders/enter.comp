#version 460
// The entering pass: every pixel's ray goes to its first cell that may matter. Rays that have none are done.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "walk.glsl"
#include "picture.glsl"
#include "rays.glsl"

void main() {
  ivec2 pixel = lane_pixel();
  bool inside = in_picture(pixel);
  Ray ray = make_ray(pixel);
  Walk walk = begin_walk(ray, ray.begin, ray.begin);
  bool found = find_cell(ray, walk, inside && ray.begin < ray.end, 0u);
  append_ray(found, PendingRay(pixel, walk.t, walk_until(walk)));
  if (inside && !found) write_pixel(pixel, rvec4(parameters.background.rgb, 0.0), rvec4(0.0, 0.0, 0.0, NO_HIT));
#ifdef COST
  // The next pass looks at the cell found again.
  if (inside) write_cost(pixel, rvec3(0.0, real(walk.steps - (found ? 1u : 0u)), real(walk.intervals)));
#endif
}

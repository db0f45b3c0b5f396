#version 460
// The tracing pass where rays go on behind a hit, and for marching: the rays that may meet something, one a lane. Composed of what the scene asks for
// (render/kernel.cpp lists the parts).
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "coefficients.glsl"
#include "spline.glsl"
#include "isosurfaces.glsl"
#include "walk.glsl"
#include "picture.glsl"
#include "surfaces.glsl"
#include "root.glsl"
#include "hit.glsl"
#include "rays.glsl"
#include "intersect.glsl"

void main() {
  uint number = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
  bool mine = number < ray_count;
  PendingRay pending = pending_ray(mine ? number : 0u);
  Ray ray = make_ray(pending.pixel);
  Caster caster = begin_caster(ray, begin_walk(ray, pending.t, pending.until));
  Seen seen = nothing_seen();
  ExactRay exact = make_exact_ray(pending.pixel);
  Root root;
#ifdef COMPOSITE
  bool seeking = mine;
  do {
    bool hit = next_hit(ray, caster, seeking, false, root);
    if (hit) see_root(seen, ray, exact, root);
    seeking = seeking && caster.live && seen.transmittance > 0.0;
  } while (subgroupAny(seeking));
#else
  if (next_hit(ray, caster, mine, false, root)) see_root(seen, ray, exact, root);
#endif
  if (mine) {
    write_pixel(pending.pixel, vec4(seen.color + seen.transmittance * parameters.background.rgb, 1.0 - seen.transmittance), seen.first);
#ifdef COST
    vec3 before = read_cost(pending.pixel);
    write_cost(pending.pixel, before + vec3(float(caster.evaluations), float(caster.walk.steps), float(caster.walk.intervals)));
#endif
  }
}

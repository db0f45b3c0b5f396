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
#ifdef VOLUME
#include "volume.glsl"
#endif

void main() {
  uint number = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
  bool mine = number < ray_count;
  PendingRay pending = pending_ray(mine ? number : 0u);
  Ray ray = make_ray(pending.pixel);
  Caster caster = begin_caster(ray, begin_walk(ray, pending.t, pending.until));
  Seen seen = nothing_seen();
  ExactRay exact = make_exact_ray(pending.pixel);
  Root root;
#ifdef VOLUME
  VolumeRay volume = begin_volume(ray, pending.pixel, begin_walk(ray, pending.t, pending.until));
#endif
#ifdef COMPOSITE
  bool seeking = mine;
  do {
    bool hit = next_hit(ray, caster, seeking, false, root);
#ifdef VOLUME
    // What is in front of the hit, or up to the ray's end where no further one is.
    integrate(ray, volume, seeking && (hit || !caster.live), hit ? root.t : ray.end, seen);
    hit = hit && !opaque(seen);
#endif
    if (hit) see_root(seen, ray, exact, root);
    seeking = seeking && caster.live && seen.transmittance > 0.0;
#ifdef VOLUME
    seeking = seeking && !opaque(seen);
    // Behind the last hit.
    integrate(ray, volume, mine && !seeking && !opaque(seen) && seen.transmittance > 0.0, ray.end, seen);
#endif
  } while (subgroupAny(seeking));
#else
  if (next_hit(ray, caster, mine, false, root)) see_root(seen, ray, exact, root);
#endif
  if (mine) {
    write_pixel(pending.pixel, over_background(seen), seen.first);
#ifdef COST
    vec3 before = read_cost(pending.pixel);
    write_cost(pending.pixel, before + vec3(float(caster.evaluations), float(caster.walk.steps), float(caster.walk.intervals)));
#endif
  }
}

#version 460
// The tracing pass where rays go on behind a hit, and for marching: the rays that may meet something, one a lane. Composed of what the scene asks for
// (render/kernel.cpp lists the parts).
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "real.glsl"
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
#ifdef BRICKS
#include "park.glsl"
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
  bool have_root = false;
#ifdef BRICKS
  bool parked_ray = false;
  uint state = ray_list[mine ? number : 0u].w;
  mine = mine && state != RAY_DONE;
  if (mine && state == RAY_PARKED) {
    seen = parked_seen(number);
    have_root = take_up_caster(number, ray, caster, root);
#ifdef VOLUME
    take_up_volume(number, volume);
#endif
  }
#endif
  // From root to root: what is in front of it, then the root itself.
  bool seeking = mine;
  do {
    Root next;
    bool found = next_hit(ray, caster, seeking && !have_root, false, next);
    if (found) root = next;
    have_root = have_root || found;
#ifdef BRICKS
    parked_ray = parked_ray || (!have_root && caster.parked);
#endif
#ifdef VOLUME
    bool known = seeking && (have_root || !caster.live);
#ifdef BRICKS
    known = known && !parked_ray;
#endif
    integrate(ray, volume, known, have_root ? root.t : ray.end, seen);
    bool reached = have_root;
#ifdef BRICKS
    parked_ray = parked_ray || volume.parked;
    reached = reached && !parked_ray;
#endif
    bool covered = opaque(seen);
#else
    bool reached = have_root;
    const bool covered = false;
#endif
#ifdef BRICKS
    if (seeking && reached && !covered && !brick_resident(root.cell)) {
      request_brick(root.cell);
      parked_ray = true;
      reached = false;
    }
#endif
    if (seeking && reached && !covered) see_root(seen, ray, exact, root);
    bool more = caster.live || (have_root && !reached);
#ifdef VOLUME
    more = more || reached;  // the volume behind it
#endif
    have_root = have_root && !reached;
    seeking = seeking && more && !covered && seen.transmittance > 0.0;
#ifdef BRICKS
    seeking = seeking && !parked_ray;
#endif
  } while (subgroupAny(seeking));
#ifdef BRICKS
  if (mine) ray_list[number].w = parked_ray ? RAY_PARKED : RAY_DONE;
  if (mine && parked_ray) {
    park_seen(number, seen);
    park_caster(number, caster, have_root, root);
#ifdef VOLUME
    park_volume(number, volume);
#endif
  }
#endif
#else
  if (next_hit(ray, caster, mine, false, root)) see_root(seen, ray, exact, root);
#endif
  if (mine) {
    write_pixel(pending.pixel, over_background(seen), seen.first);
#ifdef COST
    rvec3 before = read_cost(pending.pixel);
    write_cost(pending.pixel, before + rvec3(real(caster.evaluations), real(caster.walk.steps), real(caster.walk.intervals)));
#endif
  }
}

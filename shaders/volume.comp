#version 460
// The pass of direct volume rendering where there are no surfaces: the rays that may meet opacity, one a lane.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "coefficients.glsl"
#include "spline.glsl"
#include "walk.glsl"
#include "picture.glsl"
#include "seen.glsl"
#include "rays.glsl"
#include "volume.glsl"
#ifdef BRICKS
#include "park.glsl"
#endif

void main() {
  uint number = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
  bool mine = number < ray_count;
  PendingRay pending = pending_ray(mine ? number : 0u);
  Ray ray = make_ray(pending.pixel);
  VolumeRay volume = begin_volume(ray, pending.pixel, begin_walk(ray, pending.t, pending.until));
  Seen seen = nothing_seen();
#ifdef BRICKS
  uint state = ray_list[mine ? number : 0u].w;
  mine = mine && state != RAY_DONE;
  if (mine && state == RAY_PARKED) {
    seen = parked_seen(number);
    take_up_volume(number, volume);
  }
#endif
  integrate(ray, volume, mine, ray.end, seen);
#ifdef BRICKS
  if (mine) ray_list[number].w = volume.parked ? RAY_PARKED : RAY_DONE;
  if (mine && volume.parked) {
    park_seen(number, seen);
    park_volume(number, volume);
  }
#endif
  if (mine) {
    write_pixel(pending.pixel, over_background(seen), seen.first);
#ifdef COST
    rvec3 before = read_cost(pending.pixel);
    write_cost(pending.pixel, before + rvec3(real(volume.evaluations), real(volume.walk.steps), real(volume.walk.intervals)));
#endif
  }
}

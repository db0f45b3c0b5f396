#version 460
// The seeking pass of opaque exact surfaces: every listed ray's first root replaces the ray in the list. A subgroup has a stretch
// of the list, and a lane whose ray has ended takes the stretch's next one, so that lanes do not wait for the longest ray.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
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
#include "root.glsl"
#include "rays.glsl"
#include "intersect.glsl"

void main() {
  uint share = 64u / gl_NumSubgroups * uint(parameters.bricks.w);
  uint next = (gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID) * share;
  uint last = min(next + share, ray_count);
  bool busy = false;
  uint number = 0u;
  PendingRay pending = pending_ray(0u);
  Ray ray = make_ray(pending.pixel);
  Caster caster = begin_caster(ray, begin_walk(ray, pending.t, pending.until));
  do {
    uvec4 idle = subgroupBallot(!busy);
    uint candidate = next + subgroupBallotExclusiveBitCount(idle);
    bool take = !busy && candidate < last;
    next = min(next + subgroupBallotBitCount(idle), max(last, next));
    if (take) {
      number = candidate;
      pending = pending_ray(candidate);
      ray = make_ray(pending.pixel);
      caster = begin_caster(ray, begin_walk(ray, pending.t, pending.until));
    }
    busy = busy || take;

    Root root;
    bool hit = next_hit(ray, caster, busy, next < last, root);
    bool ended = busy && (hit || !caster.live);
    if (ended) {
#ifdef DOUBLE
      uvec4 packed = pack_root(hit, root);
      ray_list[2u * number] = uvec4(pack_pixel(pending.pixel), 0u, packed.xy);
      ray_list[2u * number + 1u] = uvec4(packed.zw, 0u, 0u);
#else
      ray_list[number] = uvec4(pack_pixel(pending.pixel), pack_root(hit, root));
#endif
#ifdef COST
      rvec3 before = read_cost(pending.pixel);
      write_cost(pending.pixel, before + rvec3(real(caster.evaluations), real(caster.walk.steps), real(caster.walk.intervals)));
#endif
    }
    busy = busy && !ended;
  } while (subgroupAny(busy) || next < last);
}

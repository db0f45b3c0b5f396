#version 460
// The ray caster: one kernel, composed of what the scene asks for (render/kernel.cpp lists the parts).
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "coefficients.glsl"
#include "spline.glsl"
#include "isosurfaces.glsl"
#include "walk.glsl"
#include "picture.glsl"
#include "surfaces.glsl"
#include "hit.glsl"
#include "intersect.glsl"

void main() {
  ivec2 pixel = lane_pixel();
  bool inside = in_picture(pixel);
  Ray ray = make_ray(pixel);
  Caster caster = begin_caster(ray);
  Seen seen = nothing_seen();
  Root root;
#ifdef COMPOSITE
  bool seeking = inside;
  do {
    bool hit = next_hit(ray, caster, seeking, root);
    if (hit) see_root(seen, ray, root);
    seeking = hit && seen.transmittance > 0.0;
  } while (subgroupAny(seeking));
#else
  if (next_hit(ray, caster, inside, root)) see_root(seen, ray, root);
#endif
  if (inside) {
    write_pixel(pixel, seen);
#ifdef COST
    count_cost(pixel, caster.evaluations, caster.walk.steps, caster.walk.intervals);
#endif
  }
}

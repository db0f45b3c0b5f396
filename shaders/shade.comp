#version 460
// The shading pass of opaque exact surfaces: every listed ray's root (seek.comp) becomes an exact hit and a pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "coefficients.glsl"
#include "spline.glsl"
#include "isosurfaces.glsl"
#include "picture.glsl"
#include "surfaces.glsl"
#include "root.glsl"
#include "hit.glsl"
#include "rays.glsl"

void main() {
  uint number = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
  bool mine = number < ray_count;
#ifdef DOUBLE
  uvec4 noted = ray_list[mine ? 2u * number : 0u];
#else
  uvec4 noted = ray_list[mine ? number : 0u];
#endif
  ivec2 pixel = unpack_pixel(noted.x);
  Ray ray = make_ray(pixel);
  Seen seen = nothing_seen();
  Root root;
#ifdef DOUBLE
  bool hit = unpack_root(uvec4(noted.zw, ray_list[mine ? 2u * number + 1u : 1u].xy), root);
  if (hit) see_root(seen, ray, make_exact_ray(pixel), root);
#else
  if (unpack_root(noted.yzw, root)) see_root(seen, ray, make_exact_ray(pixel), root);
#endif
  if (mine) write_pixel(pixel, over_background(seen), seen.first);
}

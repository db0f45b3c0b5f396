// How surfaces join what a ray has met.
#include "seen.glsl"
#include "shade.glsl"

#ifdef COMPOSITE
// Front to back.
void composite(inout Seen seen, rvec3 lit, real opacity, rvec4 hit_here) {
  seen.first = seen.first.w == NO_HIT ? hit_here : seen.first;
  seen.color += seen.transmittance * opacity * lit;
  seen.transmittance *= 1.0 - opacity;
}
#endif

// Adds a hit of surface k.
void see(inout Seen seen, Ray ray, int k, rvec3 gradient, real depth) {
  rvec3 normal = facing_normal(ray, gradient);
  rvec3 lit = headlight(isosurface[2 * k + 1].rgb, normal, ray.view);
#ifdef COMPOSITE
  composite(seen, lit, isosurface[2 * k].y, rvec4(normal, depth));
#else
  seen.first = rvec4(normal, depth);
  seen.color = lit;
  seen.transmittance = 0.0;
#endif
}

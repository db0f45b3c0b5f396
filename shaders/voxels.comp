#version 460
// Single-sample direct volume rendering of voxels (M. Kinkelin, "GPU Volume Raycasting using Bounding Interval Hierarchies", TU Wien 2009): every voxel that
// a ray meets is one sample, as opaque as its length along the ray is worth, composited front to back.
//
// Voxels are passed in the order of (entry, exit, number), which does not depend on the tree: a ray looks for the next few that come after the last one it
// passed, composites them, and looks again. So the order is right where boxes of the tree overlap, as those of merged voxels and of spheres do, and as
// planes rounded outwards do everywhere.
#extension GL_GOOGLE_include_directive : require

#include "real.glsl"
#include "shared/trace_parameters.h"
#include "shared/voxel_parameters.h"
#include "ray.glsl"
#include "picture.glsl"
#include "seen.glsl"
#include "voxel.glsl"
#include "nearest_voxels.glsl"

// World length of the ray from t to t + 1.
float world_per_t(ivec2 pixel) {
  float x = float(2 * pixel.x + 1 - parameters.picture.x) / float(parameters.picture.x);
  float y = float(parameters.picture.y - 2 * pixel.y - 1) / float(parameters.picture.y);
  precise float lattice = length(parameters.forward_hi.xyz + (x * parameters.right_hi.xyz + y * parameters.up_hi.xyz));
  precise float world = length(parameters.world_forward.xyz + x * parameters.world_right.xyz + y * parameters.world_up.xyz);
  return world / lattice;
}
// World length from the eye to t = 0.
float world_depth(ivec2 pixel) {
  float x = float(2 * pixel.x + 1 - parameters.picture.x) / float(parameters.picture.x);
  float y = float(parameters.picture.y - 2 * pixel.y - 1) / float(parameters.picture.y);
  return parameters.base_hi.w * length(parameters.world_forward.xyz + x * parameters.world_right.xyz + y * parameters.world_up.xyz);
}

void main() {
  ivec2 pixel = lane_pixel();
  bool inside = in_picture(pixel);
  Ray ray = make_ray(pixel);
  float scale = world_per_t(pixel), depth = world_depth(pixel);
  float cells_per_t = scale / parameters.sampling.x;
  Seen seen = nothing_seen();
  Visit last = Visit(-NO_HIT, -NO_HIT, -1);
  bool busy = inside && voxels.counts.x > 0 && ray.begin < ray.end;
  uint composited = 0u;
  while (busy) {
    find_nearest(ray, last);
    for (int n = 0; n < NEAREST; ++n) {
      Visit visit = nearest[n];
      bool here = visit.number >= 0 && seen.transmittance > parameters.sampling.z;
      vec4 stretch = voxel_stretch(ray, max(visit.number, 0), visit.entry, cells_per_t * (visit.exit - visit.entry));
      float transmittance = seen.transmittance;
      seen.color += here ? transmittance * stretch.rgb : vec3(0.0);
      seen.transmittance = here ? transmittance * (1.0 - stretch.a) : transmittance;
      bool half_seen = here && seen.first.w == NO_HIT && seen.transmittance <= 0.5;
      seen.first.w = half_seen ? depth + visit.exit * scale : seen.first.w;
      composited += here ? 1u : 0u;
    }
    last = nearest[NEAREST - 1];
    busy = last.number >= 0 && seen.transmittance > parameters.sampling.z;
  }
  if (!inside) return;
  write_pixel(pixel, over_background(seen), seen.first);
#ifdef COST
  write_cost(pixel, vec3(float(visited_voxels), float(visited_nodes), float(composited)));
#endif
}

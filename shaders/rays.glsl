// The rays that may meet something: found by the entering pass, traced by the next one, packed so that no subgroup
// of it works for rays that pass everything by.

struct PendingRay {
  ivec2 pixel;
  real t;       // where the ray enters its first cell that may matter
  real until;   // how far the structure's answer reaches
};

layout(std430, binding = 8) buffer Rays {
  uint ray_count;
  uint ray_padding[3];
  uvec4 ray_list[];  // pixel x + 2^16 y; t, until, 0, or what became of the ray (root.glsl). With DOUBLE two a ray: pixel, 0, t; until, 0, 0
};

// Whether a subgroup's loop goes on: as long as a lane seeks; but only as long as more lanes seek than wait where those have
// something else to do, be it behind what they found (surfaces that let something through) or, with `others`, on other rays.
// `seekers` becomes the number of lanes that seek.
bool keep_seeking(bool seeking, bool found, bool others, inout uint seekers) {
  seekers = subgroupBallotBitCount(subgroupBallot(seeking));
#ifdef COMPOSITE
  return seekers > subgroupBallotBitCount(subgroupBallot(found));
#else
  return seekers > (others ? gl_SubgroupSize / 2u : 0u);
#endif
}

uint pack_pixel(ivec2 pixel) { return uint(pixel.x) | uint(pixel.y) << 16; }
ivec2 unpack_pixel(uint packed) { return ivec2(packed & 0xffffu, packed >> 16); }

// Appends the rays of the subgroup's lanes that have one, in the order of lanes.
void append_ray(bool have, PendingRay ray) {
  uvec4 ballot = subgroupBallot(have);
  uint first = 0u;
  if (subgroupElect()) first = atomicAdd(ray_count, subgroupBallotBitCount(ballot));
  uint number = subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(ballot);
#ifdef DOUBLE
  if (have) {
    ray_list[2u * number] = uvec4(pack_pixel(ray.pixel), 0u, unpackDouble2x32(ray.t));
    ray_list[2u * number + 1u] = uvec4(unpackDouble2x32(ray.until), 0u, 0u);
  }
#else
  if (have) ray_list[number] = uvec4(pack_pixel(ray.pixel), floatBitsToUint(ray.t), floatBitsToUint(ray.until), 0u);
#endif
}

PendingRay pending_ray(uint number) {
#ifdef DOUBLE
  uvec4 r = ray_list[2u * number];
  return PendingRay(unpack_pixel(r.x), packDouble2x32(r.zw), packDouble2x32(ray_list[2u * number + 1u].xy));
#else
  uvec4 r = ray_list[number];
  return PendingRay(unpack_pixel(r.x), uintBitsToFloat(r.y), uintBitsToFloat(r.z));
#endif
}

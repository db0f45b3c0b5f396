// The rays that may meet something: found by the entering pass, traced by the next one, packed so that no subgroup
// of it works for rays that pass everything by.

struct PendingRay {
  ivec2 pixel;
  float t;  // where the ray enters its first cell that may matter
};

layout(std430, binding = 8) buffer Rays {
  uint ray_count;
  uint ray_padding[3];
  uvec2 ray_list[];  // pixel x + 2^16 y, t
};

// Whether a subgroup's loop goes on: as long as a lane seeks, or, where lanes that found something have more to seek
// behind it, as long as more lanes seek than wait.
bool keep_seeking(bool seeking, bool waiting) {
#ifdef COMPOSITE
  return subgroupBallotBitCount(subgroupBallot(seeking)) > subgroupBallotBitCount(subgroupBallot(waiting));
#else
  return subgroupAny(seeking);
#endif
}

// Appends the rays of the subgroup's lanes that have one, in the order of lanes.
void append_ray(bool have, PendingRay ray) {
  uvec4 ballot = subgroupBallot(have);
  uint first = 0u;
  if (subgroupElect()) first = atomicAdd(ray_count, subgroupBallotBitCount(ballot));
  uint number = subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(ballot);
  if (have) ray_list[number] = uvec2(uint(ray.pixel.x) | uint(ray.pixel.y) << 16, floatBitsToUint(ray.t));
}

PendingRay pending_ray(uint number) {
  uvec2 r = ray_list[number];
  return PendingRay(ivec2(r.x & 0xffffu, r.x >> 16), uintBitsToFloat(r.y));
}

// Lists of segments made by going from leaf to leaf of the occupancy octree (accel/segments.h).
//
// One flat loop, tested at its head, in which each lane crosses a leaf a trip.
#include "ray_segments.glsl"
#include "block_number.glsl"

layout(binding = 3) uniform usamplerBuffer blockLeaf;

#ifdef DOUBLE
layout(std430, binding = 23) writeonly buffer RaySegments {
  uvec4 segments[];  // from, until
};
void write_segment(Ray ray, int n, real from, real until) { segments[segment_place(ray, n)] = uvec4(unpackDouble2x32(from), unpackDouble2x32(until)); }
#else
layout(std430, binding = 23) writeonly buffer RaySegments {
  uvec2 segments[];  // from, until
};
void write_segment(Ray ray, int n, real from, real until) { segments[segment_place(ray, n)] = floatBitsToUint(vec2(from, until)); }
#endif
layout(std430, binding = 24) buffer SegmentCounts {
  uint all_steps, all_listed, all_full;  // leaves crossed, segments, lists that are full
};

// Makes the ray's list, where `wanted`.
void list_segments(Ray ray, bool wanted) {
  int capacity = parameters.structure.x;
  int shift = parameters.blocks.w;
  int n = 0;          // segments that have ended
  bool open = false;  // one has begun:
  real from = NEVER;  // where
  real t = ray.begin;
  bool walking = wanted && t < ray.end;
  uint steps = 0u, listed = 0u;
  uint walkers = subgroupBallotBitCount(subgroupBallot(walking));
  while (walkers > 0u) {
    ivec3 block = cell_at(ray, t) >> shift;
    int leaf = int(texelFetch(blockLeaf, block_number(block)).r);
    int level = leaf >> 1;
    bool matters = walking && (leaf & 1) != 0;
    bool begins = matters && !open;
    bool ends = walking && open && !matters;
    if (ends) write_segment(ray, n, from, t);
    n += ends ? 1 : 0;
    from = begins ? t : ends ? NEVER : from;
    open = walking ? matters : open;
    real leave = exit_time(ray, (block >> level) << (level + shift), 1 << (level + shift));
    t = walking ? leave : t;
    steps += walkers;
    listed += subgroupBallotBitCount(subgroupBallot(begins));
    walking = walking && t < ray.end && !(open && n + 1 == capacity);
    walkers = subgroupBallotBitCount(subgroupBallot(walking));
  }
  if (wanted) write_segment(ray, n, from, NEVER);
  uint full = subgroupBallotBitCount(subgroupBallot(wanted && t < ray.end && open));
  if (subgroupElect()) {
    atomicAdd(all_steps, steps);
    atomicAdd(all_listed, listed);
    atomicAdd(all_full, full);
  }
}

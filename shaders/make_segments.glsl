// A ray's list of segments, made by a walk through a pyramid of blocks that are active, empty, or some of both.
#include "pyramid.glsl"
#include "segment_list.glsl"

layout(binding = 3) uniform usamplerBuffer segmentNodes;

layout(std430, binding = 24) writeonly buffer SegmentLists {
  SEGMENT segment_lists[];
};

const uint NODE_FULL = 1u, NODE_MIXED = 2u;

void make_list(Ray ray, bool mine) {
  int first = ray.place * most_segments();
  PyramidLevel level = pyramid_top();
  real t = ray.begin;
  ivec3 cell = cell_at(ray, t);
  int count = 0;       // of those written
  bool have = false;   // a segment that is not written yet
  bool open = false;   // and goes on where the ray is
  real from = t, until = t;
  bool walking = mine && t < ray.end;
  while (subgroupAny(walking)) {
    int shift = pyramid_shift(level);
    ivec3 node = cell >> shift;
    uint state = texelFetch(segmentNodes, pyramid_node(level, node)).r;
    real leave = exit_time(ray, node << shift, 1 << shift);
    bool deeper = state == NODE_MIXED;
    bool active_node = state == NODE_FULL;
    bool begins = walking && !deeper && active_node && !open;
    bool last = count == most_segments() - 1;
    if (begins && have && !last) segment_lists[first + count] = pack_segment(from, until);
    bool overflows = begins && have && last;
    count += begins && have && !last ? 1 : 0;
    from = begins && !overflows ? t : from;
    until = overflows ? ray.end : walking && !deeper && active_node ? leave : until;
    have = have || begins;
    open = walking && !deeper ? active_node : open;
    PyramidLevel next = pyramid_next(level, deeper);
    level.number = next.number;
    level.offset = next.offset;
    t = deeper ? t : leave;
    ivec3 ahead = cell_at(ray, t);
    cell = deeper ? cell : ahead;
    walking = walking && !overflows && t < ray.end;
  }
  if (mine && have) segment_lists[first + count] = pack_segment(from, until);
  count += have ? 1 : 0;
  if (mine && count < most_segments()) segment_lists[first + count] = pack_segment(ray.end, ray.end);
}

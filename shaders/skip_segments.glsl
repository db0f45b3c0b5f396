// Lists of segments (accel/segments.h), one segment a step.
#include "segment_list.glsl"

// Through a texel buffer: Mesa 22.3 loses what a loop keeps of storage buffers.
layout(binding = 9) uniform usamplerBuffer segments;

struct SkipState {
  int next;  // of the ray's list
};
SkipState begin_skip() { return SkipState(0); }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  bool ended = state.next >= most_segments();
  rvec2 segment = unpack_segment(texelFetch(segments, ray.place * most_segments() + min(state.next, most_segments() - 1)));
  ended = ended || segment.x >= ray.end;
  bool ahead = segment.y > t;
  from = ended ? ray.end : max(segment.x, t);
  until = ended ? ray.end : segment.y;
  state.next += asked && !ended ? 1 : 0;
  return asked && (ended || ahead);
}

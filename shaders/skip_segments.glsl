// The ray's list of segments (accel/segments.h), one a step.
#include "ray_segments.glsl"

layout(binding = 9) uniform usamplerBuffer raySegments;

struct SkipState {
  int next;  // segment to look at
};
SkipState begin_skip() { return SkipState(0); }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  uvec4 words = texelFetch(raySegments, segment_place(ray, min(state.next, parameters.structure.x - 1)));
#ifdef DOUBLE
  real first = packDouble2x32(words.xy), last = packDouble2x32(words.zw);
#else
  real first = uintBitsToFloat(words.x), last = uintBitsToFloat(words.y);
#endif
  // Behind the last segment nothing was written.
  bool ended = first >= ray.end || t >= ray.end;
  bool behind = !ended && last <= t;
  from = ended ? ray.end : max(first, t);
  until = ended ? ray.end : min(last, ray.end);
  state.next += asked && !ended ? 1 : 0;
  return asked && !behind;
}

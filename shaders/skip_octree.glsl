// The min/max octree (accel/octree.h), one level a step. parameters.structure: xy the pyramid, z the number of windows.
#include "pyramid.glsl"
#include "windows.glsl"

layout(binding = 3) uniform usamplerBuffer octreeBounds;

struct SkipState {
  PyramidLevel level;  // to look at next
};
SkipState begin_skip() { return SkipState(pyramid_top()); }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  int shift = pyramid_shift(state.level);
  ivec3 node = cell >> shift;
  bool touches = touches_window(texelFetch(octreeBounds, pyramid_node(state.level, node)).rg);
  until = exit_time(ray, node << shift, 1 << shift);
  from = touches ? t : until;
  bool deeper = touches && state.level.number > 0;
  // Behind an answer the next node may be larger.
  PyramidLevel next = pyramid_next(state.level, deeper);
  state.level.number = asked ? next.number : state.level.number;
  state.level.offset = asked ? next.offset : state.level.offset;
  return asked && !deeper;
}

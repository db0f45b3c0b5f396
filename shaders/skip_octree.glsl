// The min/max octree (accel/octree.h), one level a step. parameters.structure: x the last level, which is one node, y its place
// in octreeBounds, z the number of windows.
#include "windows.glsl"

layout(binding = 3) uniform usamplerBuffer octreeBounds;

struct SkipState {
  int level;   // to look at next
  int offset;  // its place in octreeBounds
};
SkipState begin_skip() { return SkipState(parameters.structure.x, parameters.structure.y); }

ivec3 octree_size(int level) { return (parameters.blocks.xyz + ((1 << level) - 1)) >> level; }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  int shift = parameters.blocks.w + state.level;
  ivec3 node = cell >> shift;
  ivec3 size = octree_size(state.level);
  uvec2 bounds = texelFetch(octreeBounds, state.offset + (node.z * size.y + node.y) * size.x + node.x).rg;
  bool touches = touches_window(bounds);
  until = exit_time(ray, node << shift, 1 << shift);
  from = touches ? t : until;
  bool deeper = touches && state.level > 0;
  // Behind an answer the next node may be larger.
  int level = deeper ? state.level - 1 : min(state.level + 1, parameters.structure.x);
  ivec3 finer = octree_size(max(state.level - 1, 0));
  int up = level > state.level ? size.x * size.y * size.z : 0;
  int offset = deeper ? state.offset - finer.x * finer.y * finer.z : state.offset + up;
  state.level = asked ? level : state.level;
  state.offset = asked ? offset : state.offset;
  return asked && !deeper;
}

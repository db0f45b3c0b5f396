// A hybrid grid (accel/hybrid.h): the leaves of a shallow k-d tree, disjoint and in the order in which every ray from the eye meets them, and a
// grid of blocks inside them. One step crosses a block of the leaf that the ray is in, or goes to the next leaf. What includes
// this file defines hybrid_active(block). parameters.structure: x the number of leaves.
#include "box.glsl"

struct SkipState {
  int leaf;  // the first that the ray has not left
};
SkipState begin_skip() { return SkipState(0); }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  bool ended = state.leaf >= parameters.structure.x;
  Box box = fetch_box(ray, state.leaf);
  bool met = !ended && max(box.entry, t) < box.exit;
  bool inside = met && box.entry <= t;
  int shift = parameters.blocks.w;
  ivec3 block = cell >> shift;
  bool active_block = hybrid_active(block);
  real leave = exit_time(ray, block << shift, 1 << shift);
  until = inside ? leave : met ? box.entry : ray.end;
  from = inside && active_block ? t : until;
  // The leaf's faces are such of blocks: the ray leaves both at the same time.
  bool left = !met || (inside && leave >= box.exit);
  state.leaf += asked && !ended && left ? 1 : 0;
  return asked && (met || ended);
}

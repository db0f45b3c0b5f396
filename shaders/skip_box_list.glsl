// Disjoint boxes in the order in which every ray from the eye meets them (accel/kdtree.h, shallow trees), one a step.
// parameters.structure: x their number.
#include "box.glsl"

struct SkipState {
  int next;
};
SkipState begin_skip() { return SkipState(0); }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  bool ended = state.next >= parameters.structure.x;
  Box box = fetch_box(ray, state.next);
  bool met = !ended && max(box.entry, t) < box.exit;
  from = met ? max(box.entry, t) : ray.end;
  until = met ? box.exit : ray.end;
  state.next += asked && !ended ? 1 : 0;
  return asked && (met || ended);
}

// A tree of boxes (accel/box_tree.h), walked from the root for each answer: the nearest leaf that the ray leaves after t. One step
// looks at the two children of a node and goes on with the nearer one; nodes that begin behind a leaf already found are passed
// over, so that boxes of nodes may overlap (those of leaves do not). parameters.structure: x the number of leaves.
#include "box.glsl"

const int BOX_STACK = 48;  // BoxTree::max_depth
int box_stack[BOX_STACK];

struct SkipState {
  int pair;    // children to look at next: the number of the first; -1 before a search
  int height;  // of the stack
  real entry, exit;   // of the nearest leaf so far
};
SkipState begin_skip() { return SkipState(-1, 0, 0.0, 0.0); }

// Whether the ray is in the box somewhere in [t, best).
bool worth(Box box, real t, real best) { return max(box.entry, t) < box.exit && box.entry < best; }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  bool fresh = state.pair < 0;
  int pair = fresh ? 0 : state.pair;
  int height = fresh ? 0 : state.height;
  real best = fresh ? ray.end : state.entry;
  real exit = fresh ? ray.end : state.exit;

  Box a = fetch_box(ray, pair);
  Box b = fetch_box(ray, pair + 1);
  bool near_b = b.entry < a.entry;
  Box near = a, far = b;
  if (near_b) near = b, far = a;
  bool to_near = worth(near, t, best);
  bool near_leaf = to_near && near.child == BOX_LEAF;
  exit = near_leaf ? near.exit : exit;
  best = near_leaf ? max(near.entry, t) : best;
  bool to_far = worth(far, t, best);
  bool far_leaf = to_far && far.child == BOX_LEAF;
  exit = far_leaf ? far.exit : exit;
  best = far_leaf ? max(far.entry, t) : best;

  bool descend_near = to_near && !near_leaf;
  bool descend_far = to_far && !far_leaf;
  if (asked && descend_near && descend_far) box_stack[height] = int(far.child);
  height += descend_near && descend_far ? 1 : 0;
  bool pop = !descend_near && !descend_far && height > 0;
  height -= pop ? 1 : 0;
  int popped = box_stack[min(height, BOX_STACK - 1)];
  int next = descend_near ? int(near.child) : descend_far ? int(far.child) : pop ? popped : -1;
  bool done = next < 0 || best <= t;

  from = best;
  until = exit;
  state.pair = asked ? (done ? -1 : next) : state.pair;
  state.height = asked ? height : state.height;
  state.entry = asked ? best : state.entry;
  state.exit = asked ? exit : state.exit;
  return asked && done;
}

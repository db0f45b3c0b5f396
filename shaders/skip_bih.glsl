// A bounding interval hierarchy (accel/bih.h, accel/bih_build.h), walked from the root for each answer: the nearest leaf that the ray leaves after t.
// One step looks at one node: at the two planes of its children, or at the block of a leaf. The child that the ray meets first comes
// first. An entry of the stack counts as begun no later than those below it, so a leaf before the top one ends the search, whether or not
// children overlap. parameters.structure: xyz where planes are counted from, in blocks.
layout(binding = 3) uniform usamplerBuffer bihNodes;

const int BIH_STACK = 48;  // BihConfig::max_forks
const uint BIH_LEAF = 3u, BIH_ONE_CHILD = 4u;
int bih_stack[BIH_STACK];
rvec2 bih_stack_times[BIH_STACK];  // where the ray is in the node: from, until

struct SkipState {
  int node;           // to look at next; -1 before a search
  int height;         // of the stack
  real begin, end;    // of the ray in the node
  real entry, exit;   // of the nearest leaf so far
};
SkipState begin_skip() { return SkipState(-1, 0, 0.0, 0.0, 0.0, 0.0); }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  bool fresh = state.node < 0;
  int node = fresh ? 0 : state.node;
  int height = fresh ? 0 : state.height;
  real begin = fresh ? t : state.begin;
  real end = fresh ? ray.end : state.end;
  real best = fresh ? ray.end : state.entry;
  real exit = fresh ? ray.end : state.exit;

  // Planes a of all axes, which the ray crosses before planes b in a leaf or a node with one child. Of two children the first one that the ray meets ends at a,
  // the other one begins at b.
  uvec2 w = texelFetch(bihNodes, node).rg;
  uint axis = w.x & 3u;
  bool leaf = axis == BIH_LEAF;
  bool only = !leaf && (w.x & BIH_ONE_CHILD) != 0u;
  ivec3 low = leaf ? ivec3(w.x >> 16, w.y & 0xffffu, w.y >> 16) : parameters.structure.xyz + int(w.y & 0xffffu);
  ivec3 high = leaf ? low + 1 : parameters.structure.xyz + int(w.y >> 16);
  bvec3 forward = equal(ray.far, ivec3(1));
  rvec3 a = plane_times(ray, mix(high, low, forward) << parameters.blocks.w);
  rvec3 b = plane_times(ray, mix(low, high, forward) << parameters.blocks.w);
  real at_a = axis == 0u ? a.x : axis == 1u ? a.y : a.z;
  real at_b = axis == 0u ? b.x : axis == 1u ? b.y : b.z;
  int second = 1 - (axis == 0u ? ray.far.x : axis == 1u ? ray.far.y : ray.far.z);  // whether the ray meets the second child first

  real entry = max(max(a.x, max(a.y, a.z)), t);
  real leave = min(b.x, min(b.y, b.z));
  bool nearer = leaf && entry < leave && entry < best;
  best = nearer ? entry : best;
  exit = nearer ? leave : exit;

  int child = int(w.x >> 3);
  real near_begin = only ? max(begin, at_a) : begin;
  real near_end = min(end, only ? at_b : at_a);
  real far_begin = max(begin, at_b);
  bool to_near = !leaf && near_begin < near_end && near_begin < best;
  bool to_far = !leaf && !only && far_begin < end && far_begin < best;
  int near = only ? child : child + second;
  int far = child + 1 - second;
  rvec2 top = bih_stack_times[clamp(height - 1, 0, BIH_STACK - 1)];
  if (asked && to_near && to_far) {
    bih_stack[height] = far;
    bih_stack_times[height] = rvec2(height > 0 ? min(far_begin, top.x) : far_begin, end);
  }
  bool pop = !to_near && !to_far && height > 0 && top.x < best;
  height += to_near && to_far ? 1 : pop ? -1 : 0;
  int popped = bih_stack[clamp(height, 0, BIH_STACK - 1)];
  bool done = !to_near && !to_far && !pop;

  from = best;
  until = exit;
  state.node = asked ? (done ? -1 : to_near ? near : to_far ? far : popped) : state.node;
  state.height = asked ? height : state.height;
  state.begin = asked ? (to_near ? near_begin : to_far ? far_begin : top.x) : state.begin;
  state.end = asked ? (to_near ? near_end : to_far ? end : top.y) : state.end;
  state.entry = asked ? best : state.entry;
  state.exit = asked ? exit : state.exit;
  return asked && done;
}

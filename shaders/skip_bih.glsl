// A bounding interval hierarchy over blocks (accel/bih.h, accel/bih_build.h). One step looks at one node: at the two planes of its children, or at
// the block of a leaf. The child that the ray meets first comes first, the other one waits on a stack. Children do not overlap, so
// leaves are found in the order of the ray; each answer is the next one, and the walk goes on behind it. Where two walks share the stack, each answer
// is a search from the root. parameters.structure: xyz where planes are counted from, in blocks.
layout(binding = 3) uniform usamplerBuffer bihNodes;

const int BIH_STACK = 48;  // BihSkipping::stack
const uint BIH_LEAF = 3u, BIH_ONE_CHILD = 4u;
const int BIH_BEGIN = -1, BIH_END = -2;
int bih_stack[BIH_STACK];
rvec2 bih_stack_times[BIH_STACK];  // where the ray enters and leaves the node, among planes above it

struct SkipState {
  int node;          // to look at next; BIH_BEGIN before a walk, BIH_END behind the last leaf
  int height;        // of the stack
  real begin, end;   // of the ray in the node
};
SkipState begin_skip() { return SkipState(BIH_BEGIN, 0, 0.0, 0.0); }

bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until) {
  bool fresh = state.node == BIH_BEGIN;
  int height = fresh ? 0 : state.height;
  real begin = fresh ? t : max(state.begin, t);
  real end = fresh ? ray.end : state.end;
  bool ahead = state.node != BIH_END && begin < end;

  // Planes a of all axes, which the ray crosses before planes b in a leaf or a node with one child. Of two children the one that the ray
  // meets first ends at a, the other one begins at b.
  uvec2 w = texelFetch(bihNodes, max(state.node, 0)).rg;
  uint axis = w.x & 3u;
  bool leaf = axis == BIH_LEAF;
  bool only = (w.x & BIH_ONE_CHILD) != 0u;  // never of leaves
  ivec3 low = leaf ? ivec3(w.x >> 16, w.y & 0xffffu, w.y >> 16) : parameters.structure.xyz + int(w.y & 0xffffu);
  ivec3 high = leaf ? low + 1 : parameters.structure.xyz + int(w.y >> 16);
  bvec3 forward = equal(ray.far, ivec3(1));
  rvec3 a = plane_times(ray, mix(high, low, forward) << parameters.blocks.w);
  rvec3 b = plane_times(ray, mix(low, high, forward) << parameters.blocks.w);
  real at_a = axis == 0u ? a.x : axis == 1u ? a.y : a.z;
  real at_b = axis == 0u ? b.x : axis == 1u ? b.y : b.z;
  int second = 1 - (axis == 0u ? ray.far.x : axis == 1u ? ray.far.y : ray.far.z);  // 1 where the ray meets the second child first

  real entry = max(max(a.x, max(a.y, a.z)), t);
  real leave = min(b.x, min(b.y, b.z));
  bool hit = ahead && leaf && entry < min(leave, ray.end);
  from = hit ? entry : ray.end;
  until = hit ? leave : ray.end;

  int child = int(w.x >> 3);
  real near_begin = only ? max(begin, at_a) : begin;
  real near_end = min(end, only ? at_b : at_a);
  real far_begin = max(begin, at_b);
  bool to_near = ahead && !leaf && near_begin < near_end;
  bool to_far = ahead && !leaf && !only && far_begin < end;
  int near = only ? child : child + second;
  int far = child + 1 - second;
  bool push = to_near && to_far;
  if (asked && push) {
    bih_stack[height] = far;
    bih_stack_times[height] = rvec2(far_begin, end);
  }
  bool pop = !to_near && !to_far && height > 0;
  height += push ? 1 : pop ? -1 : 0;
  int top = min(height, BIH_STACK - 1);
  rvec2 top_times = bih_stack_times[top];
  int next = to_near ? near : to_far ? far : pop ? bih_stack[top] : BIH_END;
  bool done = hit || next == BIH_END;
#if defined(SURFACES) && defined(VOLUME)
  next = done ? BIH_BEGIN : next;
#endif
  state.node = asked ? next : state.node;
  state.height = asked ? height : state.height;
  state.begin = asked ? (to_near ? near_begin : to_far ? far_begin : top_times.x) : state.begin;
  state.end = asked ? (to_near ? near_end : to_far ? end : top_times.y) : state.end;
  return asked && done;
}

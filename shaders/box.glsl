// Boxes of blocks, as accel/box_tree.h packs them.
layout(binding = 3) uniform usamplerBuffer boxes;

const uint BOX_LEAF = 0xffffffffu;

struct Box {
  real entry, exit;   // the ray's cells are in the box from entry until exit; nowhere where exit <= entry
  uint child;         // BOX_LEAF, or the number of the first of two
};

Box fetch_box(Ray ray, int number) {
  uvec4 w = texelFetch(boxes, number);
  ivec3 low = ivec3(w.x & 0xffffu, w.x >> 16, w.y & 0xffffu) << parameters.blocks.w;
  ivec3 high = ivec3(w.y >> 16, w.z & 0xffffu, w.z >> 16) << parameters.blocks.w;
  bvec3 forward = equal(ray.far, ivec3(1));
  rvec3 enter = plane_times(ray, mix(high, low, forward));
  rvec3 leave = plane_times(ray, mix(low, high, forward));
  return Box(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)), w.w);
}

// A root along the ray, and how it is noted until its pixel is shaded.
struct Root {
  ivec3 cell;
  AxisOrder order;  // the piece it lies in
  real t;
  int surface;
};

// Behind the pixel, in ray_list: t; cell x, y; cell z, order (4 bits), surface (8 bits; 255: no root). Cells are below 2^16 a side.
const uint NO_ROOT = 255u;

#ifdef DOUBLE
// t is two numbers.
uvec4 pack_root(bool hit, Root root) {
  uint surface = hit ? uint(root.surface) : NO_ROOT;
  return uvec4(unpackDouble2x32(root.t), uint(root.cell.x) | uint(root.cell.y) << 16, uint(root.cell.z) | order_code(root.order) << 16 | surface << 24);
}
bool unpack_root(uvec4 packed, out Root root) {
  root.t = packDouble2x32(packed.xy);
  root.cell = ivec3(packed.z & 0xffffu, packed.z >> 16, packed.w & 0xffffu);
  root.order = coded_order((packed.w >> 16) & 15u);
  root.surface = int(packed.w >> 24);
  return uint(root.surface) != NO_ROOT;
}
#else
uvec3 pack_root(bool hit, Root root) {
  uint surface = hit ? uint(root.surface) : NO_ROOT;
  return uvec3(floatBitsToUint(root.t), uint(root.cell.x) | uint(root.cell.y) << 16, uint(root.cell.z) | order_code(root.order) << 16 | surface << 24);
}
bool unpack_root(uvec3 packed, out Root root) {
  root.t = uintBitsToFloat(packed.x);
  root.cell = ivec3(packed.y & 0xffffu, packed.y >> 16, packed.z & 0xffffu);
  root.order = coded_order((packed.z >> 16) & 15u);
  root.surface = int(packed.z >> 24);
  return uint(root.surface) != NO_ROOT;
}
#endif

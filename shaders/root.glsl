// A root along the ray, and how it is noted until its pixel is shaded.
struct Root {
  ivec3 cell;
  AxisOrder order;  // the piece it lies in
  real t;
  int surface;
};

// Behind the pixel, in ray_list: t; cell x, y; cell z, order (4 bits), surface (8 bits; 255: no root). Cells are below 2^16 a side.
const uint NO_ROOT = 255u;

uvec2 pack_place(bool hit, Root root) {
  uint surface = hit ? uint(root.surface) : NO_ROOT;
  return uvec2(uint(root.cell.x) | uint(root.cell.y) << 16, uint(root.cell.z) | order_code(root.order) << 16 | surface << 24);
}
bool unpack_place(uvec2 packed, inout Root root) {
  root.cell = ivec3(packed.x & 0xffffu, packed.x >> 16, packed.y & 0xffffu);
  root.order = coded_order((packed.y >> 16) & 15u);
  root.surface = int(packed.y >> 24);
  return uint(root.surface) != NO_ROOT;
}

#ifdef DOUBLE
// t is two numbers.
uvec4 pack_root(bool hit, Root root) { return uvec4(unpackDouble2x32(root.t), pack_place(hit, root)); }
bool unpack_root(uvec4 packed, out Root root) {
  root.t = packDouble2x32(packed.xy);
  return unpack_place(packed.zw, root);
}
#else
uvec3 pack_root(bool hit, Root root) { return uvec3(floatBitsToUint(root.t), pack_place(hit, root)); }
bool unpack_root(uvec3 packed, out Root root) {
  root.t = uintBitsToFloat(packed.x);
  return unpack_place(packed.yz, root);
}
#endif

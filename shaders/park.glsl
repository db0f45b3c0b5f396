// Rays that wait for a brick: what they are kept as from round to round. parked[PARKED * n ..] belongs to ray n of ray_list, whose .w says
// how far it is.
const uint RAY_PARKED = 1u, RAY_DONE = 2u;
const uint PARKED = 6u;

layout(std430, binding = 21) buffer Parked {
  uvec4 parked[];
};

void park_seen(uint n, Seen seen) {
  parked[PARKED * n] = uvec4(floatBitsToUint(seen.color), floatBitsToUint(seen.transmittance));
  parked[PARKED * n + 1u] = floatBitsToUint(seen.first);
}
Seen parked_seen(uint n) {
  uvec4 a = parked[PARKED * n];
  return Seen(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(parked[PARKED * n + 1u]));
}

#ifdef VOLUME
void park_volume(uint n, VolumeRay volume) {
  uint front = 0u, flags = 0u;
#ifdef PRE_INTEGRATED
  front = floatBitsToUint(volume.front);
  flags = volume.have ? 1u : 0u;
#endif
#ifdef ADAPTIVE
  flags = uint(volume.parts) | uint(volume.part) << 8;
#endif
  parked[PARKED * n + 2u] = uvec4(floatBitsToUint(volume.k), floatBitsToUint(volume.reached), front, flags);
}
void take_up_volume(uint n, inout VolumeRay volume) {
  uvec4 a = parked[PARKED * n + 2u];
  volume.k = uintBitsToFloat(a.x);
  volume.reached = uintBitsToFloat(a.y);
#ifdef PRE_INTEGRATED
  volume.front = uintBitsToFloat(a.z);
  volume.have = a.w != 0u;
#endif
#ifdef ADAPTIVE
  volume.parts = int(a.w & 255u);
  volume.part = int(a.w >> 8);
#endif
}
#endif

#ifdef SURFACES
void park_caster(uint n, Caster caster, bool have_root, Root root) {
  parked[PARKED * n + 3u] = uvec4(floatBitsToUint(caster.walk.t), floatBitsToUint(caster.entry), floatBitsToUint(caster.done), floatBitsToUint(caster.last_hit));
  uint flags = (caster.need_cell ? 1u : 0u) | (caster.live ? 2u : 0u) | uint(caster.level + 1) << 8;
  parked[PARKED * n + 4u] = uvec4(uint(caster.cell.x) | uint(caster.cell.y) << 16, uint(caster.cell.z), flags, 0u);
  parked[PARKED * n + 5u] = uvec4(pack_root(have_root, root), 0u);
}
// True where a root had been found that is still to be seen.
bool take_up_caster(uint n, Ray ray, inout Caster caster, inout Root root) {
  uvec4 a = parked[PARKED * n + 3u], b = parked[PARKED * n + 4u], c = parked[PARKED * n + 5u];
  caster.walk = begin_walk(ray, uintBitsToFloat(a.x), uintBitsToFloat(a.x));
  caster.entry = uintBitsToFloat(a.y);
  caster.done = uintBitsToFloat(a.z);
  caster.last_hit = uintBitsToFloat(a.w);
  caster.cell = ivec3(b.x & 0xffffu, b.x >> 16, b.y);
  caster.need_cell = (b.z & 1u) != 0u;
  caster.live = (b.z & 2u) != 0u;
  caster.level = int(b.z >> 8) - 1;
  caster.len = max(min(exit_time(ray, caster.cell, 1), ray.end) - caster.entry, 0.0);
  return unpack_root(c.xyz, root);
}
#endif

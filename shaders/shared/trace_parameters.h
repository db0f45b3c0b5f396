// What every ray caster kernel is told about the picture: declared once for C++ and GLSL (std140, offsets asserted
// against the compiled kernel by tests/render/kernel_test.cpp).
//
// Lattice coordinates are relative to the centre of the domain, so that they are small. A (hi, lo) pair is a number
// kept in two floats. With the pixel's x = (2i+1-W)/W and y = (H-2j-1)/H:
//   direction in lattice coordinates   forward + x right + y up           (not of unit length)
//   a point of the ray near the volume base + x base_right + y base_up    (= eye + plane * direction)
//
//   offset  member
//        0  forward_hi, forward_lo, right_hi, right_lo, up_hi, up_lo      .w unused
//       96  base_hi, base_lo                                              .w: plane, in units of the direction
//      128  base_right_hi, base_right_lo, base_up_hi, base_up_lo          .w unused
//      192  tangent     tan(fov/2) W/H as (hi, lo), tan(fov/2) as (hi, lo)
//      208  world_forward, world_right, world_up                          world direction, right and up times their tangent
//      256  normal_x, normal_y, normal_z                                  columns: lattice gradient to world gradient
//      304  background                                                    .w: ambient
//      320  march                                                         step, delta (lattice coordinates), their low parts
//      336  cells                                                         cells per axis; .w: number of isovalues
//      352  strides                                                       y, z, coset, number of sample (0; 0,0,0)
//      368  picture                                                       width, height, first row, rows of this dispatch
//      384  blocks                                                        blocks per axis of the skipping structure; .w: log2 of their edge
//      400  bricks                                                        occupancy bricks per axis; .w: rays a lane of the seeking pass
//      416  structure                                                     the skipping structure's own numbers (its GLSL twin says which)
//      432  sampling                                                      of a volume: length of a stretch (world) as hi, lo, least transmittance, seed (bits)
//      448  transfer                                                      low (value), entries per value (hi), last entry, entries per value (lo)
//      464  modulation                                                    low (gradient magnitude), 1/(high-low), gradients' scale, finest (entries)
//      480  pages                                                         bricks of the pool per axis; .w: log2 of their edge in cells
// and for kernels that compute in doubles (DOUBLE)
//      496  world_forward_lo, world_right_lo, world_up_lo                 of those above
//      544  normal_x_lo, normal_y_lo, normal_z_lo                         of those above
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace quincunx {
using glm::ivec4;
using glm::vec4;
struct TraceParameters {
#else
struct Parameters {
#endif
  vec4 forward_hi, forward_lo, right_hi, right_lo, up_hi, up_lo;
  vec4 base_hi, base_lo;
  vec4 base_right_hi, base_right_lo, base_up_hi, base_up_lo;
  vec4 tangent;
  vec4 world_forward, world_right, world_up;
  vec4 normal_x, normal_y, normal_z;
  vec4 background;
  vec4 march;
  ivec4 cells;
  ivec4 strides;
  ivec4 picture;
  ivec4 blocks;
  ivec4 bricks;
  ivec4 structure;
  vec4 sampling;
  vec4 transfer;
  vec4 modulation;
  ivec4 pages;
#if defined(__cplusplus) || defined(DOUBLE)
  vec4 world_forward_lo, world_right_lo, world_up_lo;
  vec4 normal_x_lo, normal_y_lo, normal_z_lo;
#endif
#ifdef __cplusplus
};
static_assert(sizeof(TraceParameters) == 592);
}  // namespace quincunx
#else
};
layout(std140, binding = 0) uniform TraceParameters {
  Parameters all;
} uniforms;
// A copy made once, as a kernel begins: lavapipe gathers what is read of a uniform block inside a loop lane by lane, each time.
Parameters parameters = uniforms.all;
#endif

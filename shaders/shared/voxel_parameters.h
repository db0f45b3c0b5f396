// What the kernel of voxels is told beside the picture: declared once for C++ and GLSL (std140, offsets asserted against the compiled kernel by
// tests/render/voxel_renderer_test.cpp).
//
//   offset  member
//        0  root_low   the low corner of the tree's box, lattice coordinates relative to the domain's centre
//       16  root_step  from one place of a plane to the next, of 65536
//       32  edge       of a sample's cuboid in half cells; .w: the axes whose edges double from level to level, 1 + 2 + 4
//       48  counts     nodes of the tree, voxels
//       64  modulation least magnitude of a gradient, 1/(greatest - least), the steepest magnitude / 16383
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace quincunx {
using glm::ivec4;
using glm::vec4;
struct VoxelParameters {
#else
struct VoxelNumbers {
#endif
  vec4 root_low, root_step;
  ivec4 edge;
  ivec4 counts;
  vec4 modulation;
#ifdef __cplusplus
};
static_assert(sizeof(VoxelParameters) == 80);
}  // namespace quincunx
#else
};
layout(std140, binding = 23) uniform VoxelParameters {
  VoxelNumbers all;
} voxelUniforms;
// A copy made once (trace_parameters.h says why).
VoxelNumbers voxels = voxelUniforms.all;
#endif

#version 460
// The listing pass, of structures that make lists of rays: every pixel's ray gets its own (make_list).
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "lane_pixel.glsl"
#include "lists.glsl"  // that of the kernel being composed

void main() {
  ivec2 pixel = lane_pixel();
  make_list(make_ray(pixel), in_picture(pixel));
}

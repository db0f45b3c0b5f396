#version 460
// The pass of structures that list, for each ray of the picture, the segments that may matter, before rays enter.
//
// The structure's file defines
//
//   void list_segments(Ray ray, bool wanted)
//
// which writes the list of each lane's ray (ray_segments.glsl), where `wanted`, and counts. Segments hold all that may matter, and end at plane_times of
// the ray, so that what is read of them keeps the contract of skip.glsl.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "real.glsl"
#include "shared/trace_parameters.h"
#include "ray.glsl"
#include "picture.glsl"
#include "segments.glsl"  // that of the kernel being composed

void main() {
  ivec2 pixel = lane_pixel();
  list_segments(make_ray(pixel), in_picture(pixel));
}

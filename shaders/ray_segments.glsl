// The lists of segments that a structure's pass makes of the rays, before they enter (segments.comp). parameters.structure.x: the most a list holds.
//
// A segment is where a ray enters it and where it leaves it, two reals of one texel; those of a ray ascend and do not touch. The last one of a list
// reaches to infinity: a list that is full says no more of the rest of its ray than that it may matter. Where the last one begins at
// infinity too, nothing more may matter.
#pragma once

const real NEVER = 1.0 / 0.0;

// Where the ray's n-th segment is: rays of 64 neighbouring pixels have theirs side by side.
int segment_place(Ray ray, int n) { return ((ray.number >> 6) * parameters.structure.x + n) * 64 + (ray.number & 63); }

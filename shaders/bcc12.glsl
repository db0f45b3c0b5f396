// Tricubic B-splines on the two cosets of the BCC lattice, halved and added (twin of spline/bcc12.cpp), 32-bit floats.
//
// A cell is an eighth of the cube between 8 samples of either coset, and the corner of it at one coset's sample is the middle of the other
// coset's cube.
const real SPLINE_SCALE = 432.0;

// A cell and where its samples are.
struct SplineCell {
  rvec3 even;          // its lowest corner relative to the domain's centre
  rvec3 sign;          // +1: coordinates go the way of the lattice's
  rvec3 from;          // where it begins in the cube of coset 0: 0 or 1/2; in that of coset 1 it is the other of the two
  int first0, first1;  // numbers of the first of the 4 x 4 x 4 samples of each coset
};

SplineCell spline_cell(ivec3 cell, rvec3 centre) {
  ivec3 i = (cell >> 1) - 1, j = ((cell - 1) >> 1) - 1;
  int origin = coefficient_origin(cell);
  SplineCell c;
  c.even = rvec3(cell) - centre;
  c.sign = rvec3(1.0);
  c.from = 0.5 * rvec3(cell & 1);
  c.first0 = origin + i.x + i.y * parameters.strides.x + i.z * parameters.strides.y;
  c.first1 = origin + parameters.strides.z + j.x + j.y * parameters.strides.x + j.z * parameters.strides.y;
  return c;
}

// u of the point o + t d, clamped into the cell.
rvec3 cell_point(SplineCell c, rvec3 o, rvec3 d, real t) {
  precise rvec3 u = (o - c.even) + t * d;
  return clamp(u, rvec3(0.0), rvec3(1.0));
}

#define CUBES 2
const real CUBE_STEP = 0.5;
int cube_first(SplineCell cell, int cube) { return cube == 0 ? cell.first0 : cell.first1; }
rvec3 cube_point(SplineCell cell, int cube, rvec3 u) {
  rvec3 from = cube == 0 ? cell.from : 0.5 - cell.from;
  precise rvec3 own = from + CUBE_STEP * u;
  return own;
}

#include "one_piece.glsl"
#include "tensor_cubic.glsl"
#include "cubic_b_spline.glsl"

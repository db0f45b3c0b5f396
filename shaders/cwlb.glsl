// The cosine-weighted linear B-spline on the BCC lattice (twin of spline/cwlb.cpp), 32-bit floats. A cell is one smooth piece, no polynomial:
// surfaces are marched.
//
// E is the cell's all-even corner, O its all-odd one, opposite. From E on, u = sign * (p - E) is in [0,1]^3: the even samples about the
// cell are those of the cube from E on, twice as large, in which u/2 is the place, and the odd ones those of the cube back from O, with (1 - u)/2.
// The even coset's weight is 1/2 + the sum of cos(pi u) over the axes / 6.
const real SPLINE_SCALE = 1.0;
#include "bcc_cell.glsl"
#include "one_piece.glsl"
#include "corners.glsl"

// The corners of a cube of a coset from one of them on.
Corners coset_cube(int corner, ivec3 step) {
  int z = corner + step.z;
  return Corners(rvec4(coefficient(corner), coefficient(corner + step.x), coefficient(corner + step.y), coefficient(corner + step.x + step.y)),
                 rvec4(coefficient(z), coefficient(z + step.x), coefficient(z + step.y), coefficient(z + step.x + step.y)));
}

// sin(pi y) and cos(pi y) for |y| <= 1/2 by their series: the first term left out is below 7e-10, of doubles 2e-18. GLSL promises 5e-4 of its
// own functions, and has none of doubles.
rvec3 sine(rvec3 y) {
  rvec3 z = y * y;
#ifdef DOUBLE
  return y * (3.1415926535897932385lf + z * (-5.1677127800499700292lf + z * (2.5501640398773454439lf + z * (-0.59926452932079207689lf + z * (0.082145886611128228799lf +
         z * (-0.0073704309457143507773lf + z * (4.6630280576761256442e-4lf + z * (-2.1915353447830215827e-5lf + z * (7.9520540014755127848e-7lf +
         z * (-2.294842899726987311e-8lf + z * 5.3926646626081284894e-10lf))))))))));
#else
  return y * (3.141592654 + z * (-5.16771278 + z * (2.55016404 + z * (-0.5992645293 + z * (0.08214588661 + z * (-0.007370430946 + z * 0.0004663028058))))));
#endif
}
rvec3 cosine(rvec3 y) {
  rvec3 z = y * y;
#ifdef DOUBLE
  return 1.0lf + z * (-4.9348022005446793094lf + z * (4.0587121264167682182lf + z * (-1.3352627688545894959lf + z * (0.23533063035889320454lf +
         z * (-0.025806891390014060013lf + z * (0.0019295743094039230479lf + z * (-1.0463810492484570712e-4lf + z * (4.3030695870329470073e-6lf +
         z * (-1.3878952462213772114e-7lf + z * (3.6047307974625009339e-9lf + z * -7.7007071306013533798e-11lf))))))))));
#else
  return 1.0 + z * (-4.934802201 + z * (4.058712126 + z * (-1.335262769 + z * (0.2353306304 + z * (-0.02580689139 + z * (0.001929574309 - z * 0.0001046381049))))));
#endif
}

// The samples that reach a cell.
struct Samples {
  Corners even, odd;
};
Samples cell_samples(SplineCell cell) { return Samples(coset_cube(cell.E, cell.stride), coset_cube(cell.O, -cell.stride)); }

// The value at u, less `offset`, and the gradient along u.
void samples_jet(Samples s, rvec3 u, real offset, out real value, out rvec3 gradient) {
  real even, odd;
  rvec3 even_slope, odd_slope;
  corners_jet(s.even, 0.5 * u, offset, even, even_slope);
  corners_jet(s.odd, 0.5 * (1.0 - u), offset, odd, odd_slope);
  rvec3 y = 0.5 - u;
  rvec3 c = sine(y);
  precise real a = 0.5 + (c.x + c.y + c.z) * (1.0 / real(6.0));
  precise real apart = even - odd;
  precise real f = odd + a * apart;
  real pi_6 = BY_PRECISION(0.5235987756, 0.52359877559829887308lf);
  precise rvec3 g = (0.5 * a) * even_slope - (0.5 * (1.0 - a)) * odd_slope - (pi_6 * apart) * cosine(y);
  value = f;
  gradient = g;
}

#if defined(MARCH) || defined(NORMAL_CENTRAL) || defined(VOLUME)
// The value at u, less `offset`.
real spline_value(SplineCell cell, rvec3 u, real offset) {
  real value;
  rvec3 gradient;
  samples_jet(cell_samples(cell), u, offset, value, gradient);
  return value;
}

#include "spline_at.glsl"
#endif

#ifdef VOLUME
// The value at u, less `offset`, and the gradient of lattice coordinates.
void spline_jet(SplineCell cell, rvec3 u, real offset, out real value, out rvec3 gradient) {
  samples_jet(cell_samples(cell), u, offset, value, gradient);
  gradient *= cell.sign;
}
#endif

// The gradient at u, in lattice coordinates, after one Newton step `t` along d (lattice coordinates) towards the value 0 of the spline less
// `offset`. A step longer than `longest` is not made.
void spline_refine(SplineCell cell, AxisOrder order, rvec3 u, rvec3 d, real offset, real longest, out real t, out rvec3 gradient) {
  Samples s = cell_samples(cell);
  rvec3 along = cell.sign * d;
  real f;
  samples_jet(s, u, offset, f, gradient);
  t = -f / dot(gradient, along);
  t = abs(t) <= longest ? t : 0.0;
  samples_jet(s, u + t * along, offset, f, gradient);
  gradient *= cell.sign;
}

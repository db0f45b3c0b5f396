// From a root along the ray to a hit: its depth and its normal, as exact as a float can hold.
#include "exact_ray.glsl"

#ifdef NORMAL_CENTRAL
// Central differences of the spline, half-step `delta` along each lattice axis, inside the domain.
rvec3 central_gradient(Ray ray, real t) {
  rvec3 p = ray.o + t * ray.d;
  real delta = wide(parameters.march.y, parameters.march.w);
  rvec3 g = rvec3(0.0);
  for (int i = 0; i < 3; ++i) {
    rvec3 axis = rvec3(i == 0, i == 1, i == 2);
    rvec3 a = max(p - delta * axis, -ray.centre);
    rvec3 b = min(p + delta * axis, ray.centre);
    real difference = spline_value_at(b, ray.centre, 0.0) - spline_value_at(a, ray.centre, 0.0);
    g += axis * difference / max(dot(b - a, axis), 1e-6);
  }
  return g;
}
#endif

// A root of a polynomial piece made exact: one Newton step on the ray that floats only approximate.
#ifdef MARCH
const real LONGEST_REFINEMENT = 0.0;
#else
const real LONGEST_REFINEMENT = BY_PRECISION(0.02, 1e-6lf);
#endif
void see_root(inout Seen seen, Ray ray, ExactRay exact, Root root) {
  SplineCell cell = spline_cell(root.cell, ray.centre);
  real t_lo;
  rvec3 gradient;
  spline_refine(cell, root.order, exact_cell_point(exact, cell, root.t), ray.d, scaled_isovalue(root.surface),
                LONGEST_REFINEMENT, t_lo, gradient);
#ifdef NORMAL_CENTRAL
  gradient = central_gradient(ray, root.t + t_lo);
#endif
  see(seen, ray, root.surface, gradient, world_depth(exact, root.t, t_lo));
}

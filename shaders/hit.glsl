// From a root along the ray to a hit: its depth and its normal, as exact as a float can hold.

struct Root {
  ivec3 cell;
  AxisOrder order;  // the piece it lies in
  float t;
  int surface;
};

// o + t d of the ray without the rounding of floats, u of the cell.
vec3 exact_cell_point(Ray ray, SplineCell cell, float t) {
  TwoVec3 along = two_product(ray.d, vec3(t));
  along.lo += ray.d_lo * t;
  TwoVec3 p = add(add(TwoVec3(ray.o, ray.o_lo), along), TwoVec3(-cell.even, vec3(0.0)));
  return cell.sign * (p.hi + p.lo);
}

float world_depth(Ray ray, float t, float t_lo) {
  TwoFloat along = multiply(two_sum(t, t_lo), ray.world_step);
  return add(ray.depth, along).hi;
}

#ifdef NORMAL_CENTRAL
// Central differences of the spline, half-step `delta` along each lattice axis, inside the domain.
vec3 central_gradient(Ray ray, float t) {
  vec3 p = ray.o + t * ray.d;
  float delta = parameters.march.y;
  vec3 g = vec3(0.0);
  for (int i = 0; i < 3; ++i) {
    vec3 axis = vec3(i == 0, i == 1, i == 2);
    vec3 a = max(p - delta * axis, -ray.centre);
    vec3 b = min(p + delta * axis, ray.centre);
    float difference = spline_value_at(b, ray.centre, 0.0) - spline_value_at(a, ray.centre, 0.0);
    g += axis * difference / max(dot(b - a, axis), 1e-6);
  }
  return g;
}
#endif

// A root of a polynomial piece made exact: one Newton step on the ray that floats only approximate.
#ifdef MARCH
const float LONGEST_REFINEMENT = 0.0;
#else
const float LONGEST_REFINEMENT = 0.02;
#endif
void see_root(inout Seen seen, Ray ray, Root root) {
  SplineCell cell = spline_cell(root.cell, ray.centre);
  float t_lo;
  vec3 gradient;
  spline_refine(cell, root.order, exact_cell_point(ray, cell, root.t), ray.d, scaled_isovalue(root.surface),
                LONGEST_REFINEMENT, t_lo, gradient);
#ifdef NORMAL_CENTRAL
  gradient = central_gradient(ray, root.t + t_lo);
#endif
  see(seen, ray, root.surface, gradient, world_depth(ray, root.t, t_lo));
}

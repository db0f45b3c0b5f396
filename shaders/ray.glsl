// The ray of a pixel, and where it crosses the planes of the lattice.
//
// Points are o + t d in lattice coordinates relative to the domain's centre, |d| = 1, t counted from a point of the ray near the
// volume. The ray crosses the plane k of axis a at plane_time(a, k), and its cell at t is the one whose planes it
// has crossed by then: pure functions of the ray, so that nothing depends on how a structure led there.
#include "twofloat.glsl"

struct Ray {
  vec3 o, d, inverse;   // 1/d, finite
  vec3 o_lo, d_lo;      // what o and d lack
  vec3 centre;          // of the domain
  ivec3 ahead;          // the way to the next cell, +1 or -1 along each axis
  ivec3 far;            // from a cell to its plane on that way, 1 or 0
  float begin, end;     // inside the domain, before the eye nothing
  TwoFloat depth;       // world distance from the eye at t = 0
  TwoFloat world_step;  // world distance per t
  vec3 view;            // unit direction in the world
};

// (2i+1-n)/n, exact to two floats.
TwoFloat pixel_coordinate(int i, int n) { return divide(TwoFloat(float(2 * i + 1 - n), 0.0), TwoFloat(float(n), 0.0)); }

TwoVec3 plane_point(TwoFloat x, TwoFloat y, vec4 hi, vec4 lo, vec4 x_hi, vec4 x_lo, vec4 y_hi, vec4 y_lo) {
  TwoVec3 along = add(multiply(two_vec3(x), TwoVec3(x_hi.xyz, x_lo.xyz)), multiply(two_vec3(y), TwoVec3(y_hi.xyz, y_lo.xyz)));
  return add(TwoVec3(hi.xyz, lo.xyz), along);
}

// Keeps an axis the ray hardly moves along off the integer planes: a ray inside a face of the domain or of cells stays on one side.
void step_off_planes(inout Ray ray, vec3 centre) {
  vec3 nudge = max(vec3(1e-5), centre * 5e-7);
  vec3 u = ray.o + centre;
  vec3 k = round(u);
  vec3 side = mix(vec3(1.0), vec3(-1.0), greaterThanEqual(k, 2.0 * centre));
  bvec3 still = lessThan(abs(ray.d), vec3(1e-9));
  bvec3 on = lessThan(abs(u - k), nudge);
  ray.o = mix(ray.o, (k - centre) + side * nudge, bvec3(still.x && on.x, still.y && on.y, still.z && on.z));
  ray.d = mix(ray.d, mix(vec3(-1e-18), vec3(1e-18), greaterThanEqual(ray.d, vec3(0.0))), lessThan(abs(ray.d), vec3(1e-18)));
}

Ray make_ray(ivec2 pixel) {
  Ray ray;
  TwoFloat x = pixel_coordinate(pixel.x, parameters.picture.x);
  TwoFloat y = pixel_coordinate(parameters.picture.y - 1 - pixel.y, parameters.picture.y);
  TwoVec3 direction = plane_point(x, y, parameters.forward_hi, parameters.forward_lo, parameters.right_hi, parameters.right_lo,
                                  parameters.up_hi, parameters.up_lo);
  TwoVec3 base = plane_point(x, y, parameters.base_hi, parameters.base_lo, parameters.base_right_hi, parameters.base_right_lo,
                             parameters.base_up_hi, parameters.base_up_lo);
  // World length of the direction: forward, right and up are orthogonal there.
  TwoFloat tx = multiply(x, TwoFloat(parameters.tangent.x, parameters.tangent.y));
  TwoFloat ty = multiply(y, TwoFloat(parameters.tangent.z, parameters.tangent.w));
  TwoFloat world = square_root(add(TwoFloat(1.0, 0.0), add(multiply(tx, tx), multiply(ty, ty))));
  TwoFloat lattice = square_root(dot_product(direction, direction));
  TwoVec3 unit = divide(direction, two_vec3(lattice));
  TwoFloat plane = TwoFloat(parameters.base_hi.w, parameters.base_lo.w);

  ray.o = base.hi;
  ray.o_lo = base.lo;
  ray.d = unit.hi;
  ray.d_lo = unit.lo;
  ray.depth = multiply(plane, world);
  ray.world_step = divide(world, lattice);
  ray.view = normalize(parameters.world_forward.xyz + x.hi * parameters.world_right.xyz + y.hi * parameters.world_up.xyz);

  vec3 centre = 0.5 * vec3(parameters.cells.xyz);
  step_off_planes(ray, centre);
  ray.inverse = 1.0 / ray.d;
  ray.far = mix(ivec3(0), ivec3(1), greaterThan(ray.d, vec3(0.0)));
  ray.ahead = 2 * ray.far - 1;
  ray.centre = centre;
  vec3 t_low = (-centre - ray.o) * ray.inverse;
  vec3 t_high = (centre - ray.o) * ray.inverse;
  vec3 t_in = min(t_low, t_high);
  vec3 t_out = max(t_low, t_high);
  float t_eye = -plane.hi * lattice.hi;
  ray.begin = max(max(t_in.x, t_in.y), max(t_in.z, t_eye));
  ray.end = min(t_out.x, min(t_out.y, t_out.z));
  return ray;
}

// Where the ray crosses the integer planes k, one of each axis.
vec3 plane_times(Ray ray, ivec3 k) {
  precise vec3 t = ((vec3(k) - ray.centre) - ray.o) * ray.inverse;
  return t;
}

// Where the ray leaves the cube of cells low .. low + size - 1.
float exit_time(Ray ray, ivec3 low, int size) {
  vec3 t = plane_times(ray, low + size * ray.far);
  return min(t.x, min(t.y, t.z));
}

// The cell at t: for each axis the last cell whose near plane has been crossed by t.
ivec3 cell_at(Ray ray, float t) {
  // Rounding moves the point by far less than the 1/64 by which it is held back: the cell found is the one or the one before.
  vec3 u = ((ray.o + t * ray.d) + ray.centre) - vec3(ray.ahead) * 0.015625;
  ivec3 c = clamp(ivec3(floor(u)), ivec3(0), parameters.cells.xyz - 1);
  bvec3 crossed = lessThanEqual(plane_times(ray, c + ray.far), vec3(t));
  return clamp(c + mix(ivec3(0), ray.ahead, crossed), ivec3(0), parameters.cells.xyz - 1);
}

// The cell after c, which the ray leaves at t.
ivec3 next_cell(Ray ray, ivec3 c, float t) {
  bvec3 crossed = lessThanEqual(plane_times(ray, c + ray.far), vec3(t));
  return clamp(c + mix(ivec3(0), ray.ahead, crossed), ivec3(0), parameters.cells.xyz - 1);
}

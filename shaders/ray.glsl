// The ray of a pixel, and where it crosses the planes of the lattice.
//
// Points are o + t d in lattice coordinates relative to the domain's centre, |d| = 1, t counted from a point of the ray near the
// volume. The ray crosses the plane k of axis a at plane_time(a, k), and its cell at t is the one whose planes it
// has crossed by then: pure functions of the ray, so that nothing depends on how a structure led there.
struct Ray {
  rvec3 o, d, inverse;  // 1/d, finite
  rvec3 centre;         // of the domain
  ivec3 ahead;          // the way to the next cell, +1 or -1 along each axis
  ivec3 far;            // from a cell to its plane on that way, 1 or 0
  real begin, end;      // inside the domain, before the eye nothing
  rvec3 view;           // unit direction in the world
#ifdef RAY_SEGMENTS
  int number;           // of its pixel, by tiles of 8 x 8 pixels
#endif
};

#ifdef RAY_SEGMENTS
int ray_number(ivec2 pixel) {
  ivec2 p = pixel - ivec2(0, parameters.picture.z);
  int tiles = (parameters.picture.x + 7) >> 3;
  return ((p.y >> 3) * tiles + (p.x >> 3)) * 64 + (p.y & 7) * 8 + (p.x & 7);
}
#endif

// Keeps an axis the ray hardly moves along off the integer planes: a ray inside a face of the domain or of cells stays on one side.
void step_off_planes(inout Ray ray, rvec3 centre) {
  rvec3 nudge = max(rvec3(BY_PRECISION(1e-5, 1e-13lf)), centre * BY_PRECISION(5e-7, 2e-14lf));
  rvec3 u = ray.o + centre;
  rvec3 k = round(u);
  rvec3 side = mix(rvec3(1.0), rvec3(-1.0), greaterThanEqual(k, 2.0 * centre));
  bvec3 still = lessThan(abs(ray.d), rvec3(BY_PRECISION(1e-9, 1e-12lf)));
  bvec3 on = lessThan(abs(u - k), nudge);
  ray.o = mix(ray.o, (k - centre) + side * nudge, bvec3(still.x && on.x, still.y && on.y, still.z && on.z));
  const real least = BY_PRECISION(1e-18, 1e-30lf);
  ray.d = mix(ray.d, mix(rvec3(-least), rvec3(least), greaterThanEqual(ray.d, rvec3(0.0))), lessThan(abs(ray.d), rvec3(least)));
}

// The part inside the domain, not before t_eye, of the ray o + t d; |d| = 1. `view` and `number` are left to the caller.
Ray clipped_ray(rvec3 o, rvec3 d, real t_eye) {
  Ray ray;
  ray.o = o;
  ray.d = d;
  ray.view = rvec3(0.0);
#ifdef RAY_SEGMENTS
  ray.number = 0;
#endif

  rvec3 centre = 0.5 * rvec3(parameters.cells.xyz);
  step_off_planes(ray, centre);
  ray.inverse = 1.0 / ray.d;
  ray.far = mix(ivec3(0), ivec3(1), greaterThan(ray.d, rvec3(0.0)));
  ray.ahead = 2 * ray.far - 1;
  ray.centre = centre;
  rvec3 t_low = (-centre - ray.o) * ray.inverse;
  rvec3 t_high = (centre - ray.o) * ray.inverse;
  rvec3 t_in = min(t_low, t_high);
  rvec3 t_out = max(t_low, t_high);
  ray.begin = max(max(t_in.x, t_in.y), max(t_in.z, t_eye));
  ray.end = min(t_out.x, min(t_out.y, t_out.z));
  return ray;
}

Ray make_ray(ivec2 pixel) {
  real x = real(2 * pixel.x + 1 - parameters.picture.x) / real(parameters.picture.x);
  real y = real(parameters.picture.y - 2 * pixel.y - 1) / real(parameters.picture.y);
  precise rvec3 direction = wide(parameters.forward_hi.xyz, parameters.forward_lo.xyz) +
                            (x * wide(parameters.right_hi.xyz, parameters.right_lo.xyz) + y * wide(parameters.up_hi.xyz, parameters.up_lo.xyz));
  precise real len = length(direction);
  precise rvec3 d = direction / len;
  precise rvec3 o = wide(parameters.base_hi.xyz, parameters.base_lo.xyz) +
                    (x * wide(parameters.base_right_hi.xyz, parameters.base_right_lo.xyz) + y * wide(parameters.base_up_hi.xyz, parameters.base_up_lo.xyz));
  Ray ray = clipped_ray(o, d, -wide(parameters.base_hi.w, parameters.base_lo.w) * len);
  ray.view = normalize(wide(parameters.world_forward.xyz, parameters.world_forward_lo.xyz) + x * wide(parameters.world_right.xyz, parameters.world_right_lo.xyz) +
                       y * wide(parameters.world_up.xyz, parameters.world_up_lo.xyz));
#ifdef RAY_SEGMENTS
  ray.number = ray_number(pixel);
#endif
  return ray;
}

// Where the ray crosses the integer planes k, one of each axis.
rvec3 plane_times(Ray ray, ivec3 k) {
  precise rvec3 t = ((rvec3(k) - ray.centre) - ray.o) * ray.inverse;
  return t;
}

// Where the ray leaves the cube of cells low .. low + size - 1.
real exit_time(Ray ray, ivec3 low, int size) {
  rvec3 t = plane_times(ray, low + size * ray.far);
  return min(t.x, min(t.y, t.z));
}

// The cell at t: for each axis the last cell whose near plane has been crossed by t.
ivec3 cell_at(Ray ray, real t) {
  // Rounding moves the point by far less than the 1/64 by which it is held back: the cell found is the one or the one before.
  rvec3 u = ((ray.o + t * ray.d) + ray.centre) - rvec3(ray.ahead) * 0.015625;
  ivec3 c = ivec3(floor(u));
  bvec3 crossed = lessThanEqual(plane_times(ray, c + ray.far), rvec3(t));
  return clamp(c + mix(ivec3(0), ray.ahead, crossed), ivec3(0), parameters.cells.xyz - 1);
}

// The cell after c, which the ray leaves at t.
ivec3 next_cell(Ray ray, ivec3 c, real t) {
  bvec3 crossed = lessThanEqual(plane_times(ray, c + ray.far), rvec3(t));
  return clamp(c + mix(ivec3(0), ray.ahead, crossed), ivec3(0), parameters.cells.xyz - 1);
}

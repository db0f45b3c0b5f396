// The ray of a pixel in two floats each: what makes a hit exact that single floats have found. In doubles, the ray itself.
#ifdef DOUBLE
struct ExactRay {
  rvec3 o, d;       // as Ray has them, before it stepped off planes
  real depth;       // world distance from the eye at t = 0
  real world_step;  // world distance per t
};

ExactRay make_exact_ray(ivec2 pixel) {
  real x = real(2 * pixel.x + 1 - parameters.picture.x) / real(parameters.picture.x);
  real y = real(parameters.picture.y - 2 * pixel.y - 1) / real(parameters.picture.y);
  rvec3 direction = wide(parameters.forward_hi.xyz, parameters.forward_lo.xyz) +
                    (x * wide(parameters.right_hi.xyz, parameters.right_lo.xyz) + y * wide(parameters.up_hi.xyz, parameters.up_lo.xyz));
  // World length of the direction: forward, right and up are orthogonal there.
  real tx = x * wide(parameters.tangent.x, parameters.tangent.y);
  real ty = y * wide(parameters.tangent.z, parameters.tangent.w);
  real world = sqrt(1.0 + (tx * tx + ty * ty));
  real lattice = length(direction);
  ExactRay ray;
  ray.o = wide(parameters.base_hi.xyz, parameters.base_lo.xyz) +
          (x * wide(parameters.base_right_hi.xyz, parameters.base_right_lo.xyz) + y * wide(parameters.base_up_hi.xyz, parameters.base_up_lo.xyz));
  ray.d = direction / lattice;
  ray.depth = wide(parameters.base_hi.w, parameters.base_lo.w) * world;
  ray.world_step = world / lattice;
  return ray;
}

// u of the point at t, in the cell.
rvec3 exact_cell_point(ExactRay ray, SplineCell cell, real t) { return cell.sign * ((ray.o + t * ray.d) - cell.even); }

real world_depth(ExactRay ray, real t, real t_lo) { return ray.depth + (t + t_lo) * ray.world_step; }
#else
#include "twofloat.glsl"

struct ExactRay {
  TwoVec3 o, d;         // as Ray has them, before it stepped off planes
  TwoFloat depth;       // world distance from the eye at t = 0
  TwoFloat world_step;  // world distance per t
};

// (2i+1-n)/n.
TwoFloat pixel_coordinate(int i, int n) { return divide(TwoFloat(float(2 * i + 1 - n), 0.0), TwoFloat(float(n), 0.0)); }

TwoVec3 plane_point(TwoFloat x, TwoFloat y, vec4 hi, vec4 lo, vec4 x_hi, vec4 x_lo, vec4 y_hi, vec4 y_lo) {
  TwoVec3 along = add(multiply(two_vec3(x), TwoVec3(x_hi.xyz, x_lo.xyz)), multiply(two_vec3(y), TwoVec3(y_hi.xyz, y_lo.xyz)));
  return add(TwoVec3(hi.xyz, lo.xyz), along);
}

ExactRay make_exact_ray(ivec2 pixel) {
  ExactRay ray;
  TwoFloat x = pixel_coordinate(pixel.x, parameters.picture.x);
  TwoFloat y = pixel_coordinate(parameters.picture.y - 1 - pixel.y, parameters.picture.y);
  TwoVec3 direction = plane_point(x, y, parameters.forward_hi, parameters.forward_lo, parameters.right_hi, parameters.right_lo,
                                  parameters.up_hi, parameters.up_lo);
  // World length of the direction: forward, right and up are orthogonal there.
  TwoFloat tx = multiply(x, TwoFloat(parameters.tangent.x, parameters.tangent.y));
  TwoFloat ty = multiply(y, TwoFloat(parameters.tangent.z, parameters.tangent.w));
  TwoFloat world = square_root(add(TwoFloat(1.0, 0.0), add(multiply(tx, tx), multiply(ty, ty))));
  TwoFloat lattice = square_root(dot_product(direction, direction));
  ray.o = plane_point(x, y, parameters.base_hi, parameters.base_lo, parameters.base_right_hi, parameters.base_right_lo,
                      parameters.base_up_hi, parameters.base_up_lo);
  ray.d = divide(direction, two_vec3(lattice));
  ray.depth = multiply(TwoFloat(parameters.base_hi.w, parameters.base_lo.w), world);
  ray.world_step = divide(world, lattice);
  return ray;
}

// u of the point at t, in the cell.
vec3 exact_cell_point(ExactRay ray, SplineCell cell, float t) {
  TwoVec3 p = add(add(ray.o, multiply(ray.d, TwoVec3(vec3(t), vec3(0.0)))), TwoVec3(-cell.even, vec3(0.0)));
  return cell.sign * (p.hi + p.lo);
}

float world_depth(ExactRay ray, float t, float t_lo) { return add(ray.depth, multiply(two_sum(t, t_lo), ray.world_step)).hi; }
#endif

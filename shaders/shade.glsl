// What a hit looks like: headlight shading of a surface.

// The unit normal in the world, facing the viewer, from a gradient in lattice coordinates of any length.
rvec3 facing_normal(Ray ray, rvec3 gradient) {
  rvec3 n = gradient.x * wide(parameters.normal_x.xyz, parameters.normal_x_lo.xyz) + gradient.y * wide(parameters.normal_y.xyz, parameters.normal_y_lo.xyz) +
            gradient.z * wide(parameters.normal_z.xyz, parameters.normal_z_lo.xyz);
  real largest = max(abs(n.x), max(abs(n.y), abs(n.z)));
  n = largest > 0.0 ? normalize(n / largest) : -ray.view;
  return dot(n, ray.view) > 0.0 ? -n : n;
}

rvec3 headlight(rvec3 color, rvec3 normal, rvec3 view) {
  real ambient = parameters.background.w;
  return color * (ambient + (1.0 - ambient) * max(0.0, -dot(normal, view)));
}

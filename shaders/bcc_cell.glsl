// A cell of the BCC lattice, seen from its all-even corner E. `sign` leads from it to the all-odd one, O, opposite: u = sign * (p - E) is in [0,1]^3.
// A cell and where its samples are.
struct SplineCell {
  rvec3 even;    // E relative to the domain's centre
  rvec3 sign;    // +-1
  ivec3 stride;  // signed numbers of coefficients per lattice step of 2 along each axis
  int E, O;      // numbers of the corners' coefficients
};

SplineCell spline_cell(ivec3 cell, rvec3 centre) {
  ivec3 odd = cell & 1;
  ivec3 e = cell + odd;
  ivec3 s = 1 - 2 * odd;
  ivec3 stride = ivec3(1, parameters.strides.xy);
  ivec3 e2 = e >> 1;
  ivec3 o2 = (e + s) >> 1;
  SplineCell c;
  c.even = rvec3(e) - centre;
  c.sign = rvec3(s);
  c.stride = s * stride;
  int origin = coefficient_origin(cell);
  c.E = origin + e2.x + e2.y * stride.y + e2.z * stride.z;
  c.O = origin + parameters.strides.z + o2.x + o2.y * stride.y + o2.z * stride.z;
  return c;
}

// u of the point o + t d, clamped into the cell.
rvec3 cell_point(SplineCell c, rvec3 o, rvec3 d, real t) {
  precise rvec3 u = c.sign * ((o - c.even) + t * d);
  return clamp(u, rvec3(0.0), rvec3(1.0));
}

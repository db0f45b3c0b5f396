// What splines on the Cartesian lattice share: a cell is the unit cube between eight neighbouring samples.
// A cell and where its samples are.
struct SplineCell {
  rvec3 even;  // its lowest corner relative to the domain's centre
  rvec3 sign;  // +1: coordinates go the way of the lattice's
  int lowest;  // number of that corner's coefficient
};

SplineCell spline_cell(ivec3 cell, rvec3 centre) {
  SplineCell c;
  c.even = rvec3(cell) - centre;
  c.sign = rvec3(1.0);
  c.lowest = coefficient_origin(cell) + cell.x + cell.y * parameters.strides.x + cell.z * parameters.strides.y;
  return c;
}

// u of the point o + t d, clamped into the cell.
rvec3 cell_point(SplineCell c, rvec3 o, rvec3 d, real t) {
  precise rvec3 u = (o - c.even) + t * d;
  return clamp(u, rvec3(0.0), rvec3(1.0));
}

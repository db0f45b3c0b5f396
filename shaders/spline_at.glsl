// SPLINE_SCALE times the value, less `offset`, at a point of the domain, relative to the domain's centre.
real spline_value_at(rvec3 p, rvec3 centre, real offset) {
  ivec3 at = clamp(ivec3(floor(p + centre)), ivec3(0), parameters.cells.xyz - 1);
  SplineCell cell = spline_cell(at, centre);
  return spline_value(cell, cell_point(cell, p, rvec3(0.0), 0.0), offset);
}

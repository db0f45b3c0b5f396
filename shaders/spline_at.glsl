// SPLINE_SCALE times the value, less `offset`, at a point of the domain, relative to the domain's centre.
float spline_value_at(vec3 p, vec3 centre, float offset) {
  ivec3 at = clamp(ivec3(floor(p + centre)), ivec3(0), parameters.cells.xyz - 1);
  SplineCell cell = spline_cell(at, centre);
  return spline_value(cell, cell_point(cell, p, vec3(0.0), 0.0), offset);
}

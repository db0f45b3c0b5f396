// The trilinear interpolant of eight samples.
// The samples of a cube's corners (x,y) = (0,0), (1,0), (0,1), (1,1).
struct Corners {
  rvec4 low, high;  // at z = 0, 1
};

// The value at u, less `offset`, and the gradient.
void corners_jet(Corners c, rvec3 u, real offset, out real value, out rvec3 gradient) {
  rvec4 edge = rvec4(c.low.xz, c.high.xz) - offset;
  precise rvec4 rise = rvec4(c.low.yw, c.high.yw) - rvec4(c.low.xz, c.high.xz);
  precise rvec4 p = edge + u.x * rise;
  precise rvec2 p_rise = p.yw - p.xz, rise_rise = rise.yw - rise.xz;
  precise rvec2 face = p.xz + u.y * p_rise, face_rise = rise.xz + u.y * rise_rise;
  precise real z_rise = face.y - face.x;
  precise real f = face.x + u.z * z_rise;
  precise rvec3 g = rvec3(face_rise.x + u.z * (face_rise.y - face_rise.x), p_rise.x + u.z * (p_rise.y - p_rise.x), z_rise);
  value = f;
  gradient = g;
}

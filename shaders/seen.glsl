// What a ray has met so far, front to back.
struct Seen {
  rvec3 color;          // premultiplied
  real transmittance;
  rvec4 first;          // normal and depth of the first hit; of a volume without surfaces, no normal and the depth of half the opacity
};

Seen nothing_seen() { return Seen(rvec3(0.0), 1.0, rvec4(0.0, 0.0, 0.0, NO_HIT)); }

rvec4 over_background(Seen seen) { return rvec4(seen.color + seen.transmittance * parameters.background.rgb, 1.0 - seen.transmittance); }

// What a ray has met so far, front to back.
struct Seen {
  vec3 color;           // premultiplied
  float transmittance;
  vec4 first;           // normal and depth of the first hit; of a volume without surfaces, no normal and the depth of half the opacity
};

Seen nothing_seen() { return Seen(vec3(0.0), 1.0, vec4(0.0, 0.0, 0.0, NO_HIT)); }

vec4 over_background(Seen seen) { return vec4(seen.color + seen.transmittance * parameters.background.rgb, 1.0 - seen.transmittance); }

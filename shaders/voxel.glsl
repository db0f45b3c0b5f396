// A voxel: where the ray is in it, and what it shows (accel/voxels.h has the layouts).
layout(binding = 25) uniform usamplerBuffer voxelData;
#ifdef SPHERES
layout(binding = 26) uniform samplerBuffer voxelPlaces;
#else
layout(binding = 26) uniform usamplerBuffer voxelPlaces;
#endif
layout(binding = 18) uniform samplerBuffer transferTable;  // r, g, b, extinction a cell, by the density's number

// A stretch of the ray; none where exit <= entry.
struct VoxelSpan {
  float entry, exit;
};

#ifdef SPHERES
VoxelSpan voxel_span(Ray ray, int number) {
  vec4 place = texelFetch(voxelPlaces, number);
  vec3 to = place.xyz - ray.o;
  float nearest = dot(to, ray.d);
  vec3 off = to - nearest * ray.d;
  float chord = place.w * place.w - dot(off, off);
  float half_chord = sqrt(max(chord, 0.0));
  return VoxelSpan(max(nearest - half_chord, ray.begin), chord > 0.0 ? min(nearest + half_chord, ray.end) : ray.begin);
}
#else
// Planes are those of neighbours too, and met at the same time: a ray leaves one voxel where it enters the next.
VoxelSpan voxel_span(Ray ray, int number) {
  uvec2 place = texelFetch(voxelPlaces, number).xy;
  ivec3 low = ivec3(place.x & 0xffffu, place.x >> 16, place.y & 0xffffu) - 2;
  int level = int(place.y >> 16);
  ivec3 edge = voxels.edge.xyz << (ivec3(voxels.edge.w, voxels.edge.w >> 1, voxels.edge.w >> 2) & 1) * level;
  precise vec3 t_low = ((0.5 * vec3(low) - ray.centre) - ray.o) * ray.inverse;
  precise vec3 t_high = ((0.5 * vec3(low + edge) - ray.centre) - ray.o) * ray.inverse;
  vec3 t_in = min(t_low, t_high), t_out = max(t_low, t_high);
  return VoxelSpan(max(max(t_in.x, t_in.y), max(t_in.z, ray.begin)), min(min(t_out.x, t_out.y), min(t_out.z, ray.end)));
}
#endif

// 1 - exp(-x), with its digits where x is small.
float hidden_by(float x) {
  float series = x * (1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0))));
  return x < 0.0625 ? series : 1.0 - exp(-x);
}

#ifdef LIT
#ifdef SPHERES
// From the centre to where the ray enters.
vec3 voxel_normal(Ray ray, int number, float entry, uvec2 data) { return ray.o + entry * ray.d - texelFetch(voxelPlaces, number).xyz; }
#else
// The direction of the gradient in the world, of any length; 0 where there is none.
vec3 voxel_normal(Ray ray, int number, float entry, uvec2 data) {
  vec2 p = vec2(data.y & 0xffffu, data.y >> 16) * (1.0 / 32767.0) - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  vec2 turned = (1.0 - abs(p.yx)) * mix(vec2(1.0), vec2(-1.0), lessThan(p, vec2(0.0)));
  n.xy = n.z < 0.0 ? turned : n.xy;
  return data.x >> 18 == 0u ? vec3(0.0) : n;
}
#endif
// The headlight (shade.glsl), from either side.
float light_left(Ray ray, vec3 n) {
  float size = length(n);
  float facing = size > 0.0 ? min(abs(dot(n, ray.view)) / size, 1.0) : 1.0;
  return mix(facing, 1.0, parameters.background.w);
}
#endif

#ifdef MODULATED
float opacity_left(uvec2 data) {
  return clamp((float(data.x >> 18) * voxels.modulation.z - voxels.modulation.x) * voxels.modulation.y, 0.0, 1.0);
}
#endif

// What a voxel adds along `cells` of the ray, which enters it at `entry`: premultiplied colour and opacity.
vec4 voxel_stretch(Ray ray, int number, float entry, float cells) {
  uvec2 data = texelFetch(voxelData, number).xy;
  vec4 look = texelFetch(transferTable, int(data.x >> 2 & 0xffffu));
  float extinction = look.a * cells;
#ifdef MODULATED
  extinction *= opacity_left(data);
#endif
  float opacity = hidden_by(extinction);
#ifdef LIT
  look.rgb *= light_left(ray, voxel_normal(ray, number, entry, data));
#endif
  return vec4(look.rgb * opacity, opacity);
}

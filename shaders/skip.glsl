// The contract of skipping structures inside the kernel.
//
//   bool skip_probe(Ray ray, ivec3 cell, float t, inout int level, out float until)
//
// Given where the ray is (its parameter t and its cell there), says whether the ray may meet a surface from t until
// `until` > t (true), or certainly meets none (false). In the second case `level` becomes the level of that
// stretch: between which two isovalues its values lie
// (heeded only where the ray has met no value yet). `until` is a plane_time of the ray, past the domain's end perhaps.
// One call is one step of the structure's walk: the caster calls again at `until`.
#include "structure.glsl"  // that of the kernel being composed

// The contract of skipping structures inside the kernel. A twin defines
//
//   SkipState                what its walk carries from step to step and from answer to answer
//   SkipState begin_skip()   its value before the first step
//   bool skip_step(Ray ray, ivec3 cell, real t, bool asked, inout SkipState state, out real from, out real until)
//
// One call is one step of the structure's walk. `asked` says whether this lane wants it: where not, the state stays as it is and the result
// is false. The ray is at its parameter t, in `cell`. True: the structure has its answer. The ray certainly meets no surface from t
// until `from`, and may meet one from there until `until`; from = until where nothing more is known than that. False: call again,
// everything else being the same.
//
// t <= from <= until, t < until; both are t, a plane_time of the ray, or not before its end. So the cells between them are the
// same whatever structure led there, and no structure changes a picture. Answers need not say on which side of an isovalue the
// values of what is skipped are: a bound that touches no isovalue leaves no doubt about the first value behind it.
#include "structure.glsl"  // that of the kernel being composed

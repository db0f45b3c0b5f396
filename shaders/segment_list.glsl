// Lists of segments (accel/segments.h), as kernels keep them: parameters.structure.z pairs from, until a ray, ascending, no two of which touch, behind the
// last one a pair that begins at the ray's end. A list that is full ends with a segment that reaches the ray's end.
#ifdef DOUBLE
#define SEGMENT uvec4
SEGMENT pack_segment(real from, real until) { return uvec4(unpackDouble2x32(from), unpackDouble2x32(until)); }
rvec2 unpack_segment(uvec4 s) { return rvec2(packDouble2x32(s.xy), packDouble2x32(s.zw)); }
#else
#define SEGMENT uvec2
SEGMENT pack_segment(real from, real until) { return uvec2(floatBitsToUint(from), floatBitsToUint(until)); }
rvec2 unpack_segment(uvec4 s) { return rvec2(uintBitsToFloat(s.x), uintBitsToFloat(s.y)); }
#endif

int most_segments() { return parameters.structure.z; }

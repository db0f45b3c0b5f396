// The numbers that decide a picture: 32-bit floats or, with DOUBLE (--precision double), 64-bit ones. What buffers hold is spelled out: float,
// vec4. BY_PRECISION(of floats, of doubles) is a constant that rounding makes differ; wide(hi, lo) a number that the host has told
// in two floats, in doubles their sum, in floats the first alone; narrow(v) what a buffer of floats takes.
#pragma once
#ifdef DOUBLE
#define real double
#define rvec2 dvec2
#define rvec3 dvec3
#define rvec4 dvec4
#define BY_PRECISION(of_floats, of_doubles) of_doubles
double wide(float hi, float lo) { return double(hi) + double(lo); }
dvec3 wide(vec3 hi, vec3 lo) { return dvec3(hi) + dvec3(lo); }
vec4 narrow(dvec4 v) { return vec4(v); }
#else
#define real float
#define rvec2 vec2
#define rvec3 vec3
#define rvec4 vec4
#define BY_PRECISION(of_floats, of_doubles) of_floats
#define wide(hi, lo) hi
#define narrow(v) v
#endif

// The numbers that decide a picture: 32-bit floats. What buffers hold is spelled out: float, vec4.
#pragma once
#define real float
#define rvec2 vec2
#define rvec3 vec3
#define rvec4 vec4

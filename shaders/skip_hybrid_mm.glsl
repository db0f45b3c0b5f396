// A hybrid grid of minima and maxima.
#include "block_number.glsl"
#include "windows.glsl"

layout(binding = 23) uniform usamplerBuffer hybridBounds;

bool hybrid_active(ivec3 block) { return touches_window(texelFetch(hybridBounds, block_number(block)).rg); }

#include "skip_hybrid.glsl"

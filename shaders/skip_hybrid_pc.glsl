// A hybrid grid whose blocks are classified beforehand.
#include "block_number.glsl"

layout(binding = 23) uniform usamplerBuffer hybridLevel;

const uint HYBRID_ACTIVE = 255u;

bool hybrid_active(ivec3 block) { return texelFetch(hybridLevel, block_number(block)).r == HYBRID_ACTIVE; }

#include "skip_hybrid.glsl"

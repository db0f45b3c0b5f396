// What walks from block to block have in common: each answer comes from the ray's block alone.
struct SkipState {
  int unused;
};
SkipState begin_skip() { return SkipState(0); }

#include "block_number.glsl"

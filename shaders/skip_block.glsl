// What walks from block to block have in common: each answer comes from the ray's block alone.
struct SkipState {
  int unused;
};
SkipState begin_skip() { return SkipState(0); }

int block_number(ivec3 block) { return (block.z * parameters.blocks.y + block.y) * parameters.blocks.x + block.x; }

int block_number(ivec3 block) { return (block.z * parameters.blocks.y + block.y) * parameters.blocks.x + block.x; }

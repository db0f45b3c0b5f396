// The page table of the brick pool (accel/bricks.h, render/brick_pool.h). parameters.pages: bricks per axis, .w log2 of their edge in cells.
layout(binding = 19) uniform isamplerBuffer pageTable;
layout(std430, binding = 20) writeonly buffer Requests {
  uint requested[];  // by brick: 1 where a ray waits for it
};

#ifdef BRICK_UNITS
layout(binding = 22) uniform samplerBuffer brickUnits;  // offset and scale, by brick
#endif

const int NOT_RESIDENT = -0x7fffffff - 1;

int brick_number(ivec3 cell) {
  ivec3 brick = cell >> parameters.pages.w;
  return (brick.z * parameters.pages.y + brick.y) * parameters.pages.x + brick.x;
}

bool brick_resident(ivec3 cell) { return texelFetch(pageTable, brick_number(cell)).r != NOT_RESIDENT; }
void request_brick(ivec3 cell) { requested[brick_number(cell)] = 1u; }

// As an evaluation in `cell` counts coefficients; of a brick that is not resident, anything: what is read then (coefficient 0) is not used.
int coefficient_origin(ivec3 cell) {
  int number = brick_number(cell);
#ifdef BRICK_UNITS
  brick_unit = texelFetch(brickUnits, number).rg;
#endif
  int origin = texelFetch(pageTable, number).r;
  brick_here = origin != NOT_RESIDENT;
  return origin;
}

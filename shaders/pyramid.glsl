// A pyramid over blocks (accel/pyramid.h). parameters.structure: x the last level, which is one node, y its place among the nodes.
struct PyramidLevel {
  int number;  // 0: the blocks
  int offset;  // its place
};
PyramidLevel pyramid_top() { return PyramidLevel(parameters.structure.x, parameters.structure.y); }

ivec3 pyramid_size(int level) { return (parameters.blocks.xyz + ((1 << level) - 1)) >> level; }

// log2 of the edge of a level's nodes in cells.
int pyramid_shift(PyramidLevel level) { return parameters.blocks.w + level.number; }

// The place of a node.
int pyramid_node(PyramidLevel level, ivec3 node) {
  ivec3 size = pyramid_size(level.number);
  return level.offset + (node.z * size.y + node.y) * size.x + node.x;
}

// The level below, or above; the top is above itself.
PyramidLevel pyramid_next(PyramidLevel level, bool below) {
  ivec3 size = pyramid_size(level.number), finer = pyramid_size(max(level.number - 1, 0));
  int number = below ? level.number - 1 : min(level.number + 1, parameters.structure.x);
  int up = number > level.number ? size.x * size.y * size.z : 0;
  return PyramidLevel(number, below ? level.offset - finer.x * finer.y * finer.z : level.offset + up);
}

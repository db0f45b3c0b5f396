// The voxels that a ray enters next, found in their bounding interval hierarchy (accel/bih_build.h): depth first, the nearer child first, nodes
// that lie before what has been passed or behind all that is kept passed over.
layout(binding = 24) uniform usamplerBuffer voxelNodes;

const int NEAREST = 8;
const int BIH_STACK = 48;  // VoxelRenderer's kMostForks
const uint BIH_LEAF = 3u, BIH_ONE_CHILD = 4u;

// A voxel on a ray.
struct Visit {
  float entry, exit;
  int number;  // -1: none
};
// The order in which voxels are passed.
bool before(Visit a, Visit b) { return a.entry < b.entry || (a.entry == b.entry && (a.exit < b.exit || (a.exit == b.exit && a.number < b.number))); }

Visit nearest[NEAREST];  // ascending; those that are none last
uint bih_stack[BIH_STACK];
vec2 bih_spans[BIH_STACK];
#ifdef COST
uint visited_nodes = 0u, visited_voxels = 0u;
#endif

// Keeps the voxel if it comes after `last` and before one of those kept.
void keep_voxel(Ray ray, int number, Visit last) {
  VoxelSpan span = voxel_span(ray, number);
  Visit visit = Visit(span.entry, span.exit, number);
  bool wanted = span.entry < span.exit && before(last, visit) && before(visit, nearest[NEAREST - 1]);
  for (int n = 0; n < NEAREST; ++n) {
    bool swap = wanted && before(visit, nearest[n]);
    Visit kept = nearest[n];
    nearest[n].entry = swap ? visit.entry : kept.entry;
    nearest[n].exit = swap ? visit.exit : kept.exit;
    nearest[n].number = swap ? visit.number : kept.number;
    visit.entry = swap ? kept.entry : visit.entry;
    visit.exit = swap ? kept.exit : visit.exit;
    visit.number = swap ? kept.number : visit.number;
  }
}

// Where the ray crosses the plane n of the axis, `outwards` (1 or -1) by more than floats are off there.
float bih_plane_time(Ray ray, int axis, uint n, float outwards) {
  float place = voxels.root_low[axis] + float(n) * voxels.root_step[axis];
  float margin = 2e-6 * (ray.centre[axis] + abs(ray.o[axis]) + 1.0);
  return (place + outwards * margin - ray.o[axis]) * ray.inverse[axis];
}

// Fills `nearest` with the first voxels after `last`.
void find_nearest(Ray ray, Visit last) {
  for (int n = 0; n < NEAREST; ++n) nearest[n] = Visit(NO_HIT, NO_HIT, -1);
  uint node = 0u;
  vec2 span = vec2(ray.begin, ray.end);
  int height = 0;
  bool busy = true;
  while (busy) {
    uvec2 words = texelFetch(voxelNodes, int(node)).xy;
    uint kind = words.x & 3u;
    uint index = words.x >> 3;
    bool leaf = kind == BIH_LEAF;
    uint count = leaf ? words.y : 0u;
    for (uint n = 0u; n < count; ++n) keep_voxel(ray, int(index + n), last);
#ifdef COST
    visited_nodes += 1u;
    visited_voxels += count;
#endif
    int axis = leaf ? 0 : int(kind);
    // Two children: the first ends at one plane, the second begins at the other. One child is between them.
    bool one_child = !leaf && (words.x & BIH_ONE_CHILD) != 0u;
    float outwards = one_child ? -1.0 : 1.0;
    float t_first = bih_plane_time(ray, axis, words.y & 0xffffu, outwards);
    float t_second = bih_plane_time(ray, axis, words.y >> 16, -outwards);
    bool forward = ray.far[axis] == 1;
    float t_near = forward ? t_first : t_second, t_far = forward ? t_second : t_first;
    vec2 within = vec2(max(span.x, t_near), min(span.y, t_far));
    vec2 near = one_child ? within : vec2(span.x, min(span.y, t_near));
    vec2 far = vec2(max(span.x, t_far), span.y);
    float worst = nearest[NEAREST - 1].entry;
    bool to_near = !leaf && near.x <= near.y && near.y >= last.entry && near.x <= worst;
    bool to_far = !leaf && !one_child && far.x <= far.y && far.y >= last.entry && far.x <= worst;
    uint near_node = index + (forward || one_child ? 0u : 1u), far_node = index + (forward ? 1u : 0u);
    if (to_near && to_far) {
      bih_stack[height] = far_node;
      bih_spans[height] = far;
      ++height;
    }
    bool down = to_near || to_far;
    node = to_near ? near_node : far_node;
    span = to_near ? near : far;
    // The next on the stack that is not behind all that is kept.
    bool popping = !down;
    while (popping && height > 0) {
      --height;
      node = bih_stack[height];
      span = bih_spans[height];
      down = span.x <= worst;
      popping = !down;
    }
    busy = down;
  }
}

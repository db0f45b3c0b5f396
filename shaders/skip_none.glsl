// No structure: everything may matter.
bool skip_probe(Ray ray, ivec3 cell, float t, inout int level, out float until) {
  until = ray.end;
  return true;
}

// The transfer function as a table (render/transfer_table.h). Places in it are numbers of entries, 0 .. parameters.transfer.z.
layout(binding = 18) uniform samplerBuffer transferTable;

#ifdef PRE_INTEGRATED
// What a stretch from the place `front` to `back` adds: bilinear between entries.
vec4 pre_integrated(float front, float back) {
  int n = int(parameters.transfer.z) + 1;
  int i = min(int(front), n - 2), j = min(int(back), n - 2);
  float x = front - float(i), y = back - float(j);
  int first = j * n + i;
  vec4 low = mix(texelFetch(transferTable, first), texelFetch(transferTable, first + 1), x);
  vec4 high = mix(texelFetch(transferTable, first + n), texelFetch(transferTable, first + n + 1), x);
  return mix(low, high, y);
}
#else
// What a whole stretch of the place x adds: linear between entries.
vec4 classified(float x) {
  int i = min(int(x), int(parameters.transfer.z) - 1);
  vec4 a = texelFetch(transferTable, i);
  vec4 b = texelFetch(transferTable, i + 1);
  return mix(a, b, x - float(i));
}
#endif

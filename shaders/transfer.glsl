// The transfer function as a table (render/transfer_table.h). Places in it are numbers of entries, 0 .. parameters.transfer.z.
layout(binding = 18) uniform samplerBuffer transferTable;

// The opacity of a part of a stretch's length, or of its extinction, with its colour: 1 - (1 - a)^part. Where a is small, by the binomial
// series, which keeps its digits.
rvec4 share_of(rvec4 stretch, real part) {
  real a = stretch.a;
  real series = part * (1.0 + (1.0 - part) / 2.0 * a * (1.0 + (2.0 - part) / 3.0 * a * (1.0 + (3.0 - part) / 4.0 * a * (1.0 + (4.0 - part) / 5.0 * a))));
  real ratio = a < 0.0625 ? series : (1.0 - pow(float(max(1.0 - a, 2.98023224e-8)), float(part))) / a;
  return part < 1.0 ? stretch * ratio : stretch;
}

#ifdef PRE_INTEGRATED
// A stretch of a whole one's length between two places inside the table: bilinear between entries.
rvec4 pre_integrated_inside(real front, real back) {
  int n = int(parameters.transfer.z) + 1;
  int i = min(int(front), n - 2), j = min(int(back), n - 2);
  real x = front - real(i), y = back - real(j);
  int first = j * n + i;
  rvec4 low = mix(texelFetch(transferTable, first), texelFetch(transferTable, first + 1), x);
  rvec4 high = mix(texelFetch(transferTable, first + n), texelFetch(transferTable, first + n + 1), x);
  return mix(low, high, y);
}
// One beyond the table, on the side of the place x, which is one of its ends.
rvec4 pre_integrated_beyond(real x) {
  int n = int(parameters.transfer.z) + 1;
  return texelFetch(transferTable, x > 0.0 ? n * n - 1 : 0);
}

// What a stretch from the place `front` to `back` adds. A place beyond the table is of the value at its end, but the value goes there and
// back at the pace of the whole: what is inside is a part of the stretch.
rvec4 pre_integrated(real front, real back) {
  real f = clamp(front, 0.0, parameters.transfer.z), b = clamp(back, 0.0, parameters.transfer.z);
  rvec4 inside = pre_integrated_inside(f, b);
  real way = abs(back - front);
  bool leaves = (front != f || back != b) && f != b;
  rvec4 before = share_of(pre_integrated_beyond(f), leaves ? abs(f - front) / way : 0.0);
  rvec4 after = share_of(pre_integrated_beyond(b), leaves ? abs(back - b) / way : 0.0);
  inside = share_of(inside, leaves ? abs(b - f) / way : 1.0);
  rvec4 both = before + (1.0 - before.a) * inside;
  return both + (1.0 - both.a) * after;
}
#else
// What a whole stretch of the place x adds: linear between entries.
rvec4 classified(real x) {
  int i = min(int(x), int(parameters.transfer.z) - 1);
  rvec4 a = texelFetch(transferTable, i);
  rvec4 b = texelFetch(transferTable, i + 1);
  return mix(a, b, x - real(i));
}
#endif

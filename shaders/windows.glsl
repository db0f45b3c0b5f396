// Bounds against the ranges of values that can be seen (accel/kernel_windows.h). parameters.structure: z the number of windows.
layout(binding = 9) uniform usamplerBuffer windows;

// Whether bounds (x min, y max) touch a range.
bool touches_window(uvec2 bounds) {
#if RANGES == 1
  uvec2 window = texelFetch(windows, 0).rg;
  bool touches = bounds.x < window.x && bounds.y >= window.y;
#else
  bool touches = false;
  for (int k = 0; k < parameters.structure.z; ++k) {
    uvec2 window = texelFetch(windows, k).rg;
    touches = touches || (bounds.x < window.x && bounds.y >= window.y);
  }
#endif
#ifdef VOIDS
  touches = touches && bounds.x <= bounds.y;  // not all of it is void
#endif
  return touches;
}

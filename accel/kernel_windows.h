// Ranges of values as kernels compare bounds with them (shaders/windows.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "accel/thresholds.h"

namespace quincunx {

/// Bounds (quantised like CellBounds) that are not empty touch the range where min < above_min and max >= lowest_max. Buffer `windows`:
/// 2 x uint32 each.
struct KernelWindow {
  std::uint32_t above_min = 0, lowest_max = 0;
};

/// One for each range that some bounds can touch, at least one; (0, 0) is touched by nothing.
inline std::vector<KernelWindow> kernel_windows(const Thresholds& thresholds) {
  std::vector<KernelWindow> windows;
  for (const auto [highest_min, lowest_max] : thresholds.windows()) windows.push_back({highest_min + 1u, lowest_max});
  if (windows.empty()) windows.emplace_back();
  return windows;
}

}  // namespace quincunx

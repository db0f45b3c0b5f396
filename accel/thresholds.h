// Isovalues seen from quantised bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/bounds.h"

namespace quincunx {

/// Compares quantised intervals with a set of isovalues exactly: value(q) as CellBounds computes it, in double.
/// An interval touches an isovalue where value(min) <= isovalue <= value(max).
class Thresholds {
 public:
  /// `isovalues` ascend. Throws InputError, naming --iso, where there are more than 254.
  Thresholds(const CellBounds& scale, std::span<const double> isovalues);

  /// An interval touches this isovalue where min <= highest_min and max >= lowest_max.
  struct Window {
    std::uint16_t highest_min, lowest_max;
  };
  /// One for each isovalue that some interval can touch.
  const std::vector<Window>& windows() const { return windows_; }

  /// Number of isovalues below value(q).
  std::uint8_t below(std::uint16_t q) const { return below_[q]; }
  /// Number of isovalues at or below value(q).
  std::uint8_t up_to(std::uint16_t q) const { return up_to_[q]; }
  bool touches(std::uint16_t min, std::uint16_t max) const { return up_to(max) > below(min); }

 private:
  std::vector<Window> windows_;
  std::vector<std::uint8_t> below_, up_to_;
};

}  // namespace quincunx

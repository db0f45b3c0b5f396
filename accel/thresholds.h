// Ranges of values seen from quantised bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/bounds.h"

namespace quincunx {

/// Compares quantised intervals with ranges of values exactly: value(q) as the scale computes it, in double.
/// An interval touches a range where value(min) <= high and low <= value(max); an empty one (min > max) touches none.
class Thresholds {
 public:
  /// `ranges` ascend and are disjoint. Throws InputError, naming --iso, where there are more than 254 (those of transfer functions are joined before).
  Thresholds(const ValueScale& scale, std::span<const ValueRange> ranges);

  /// An interval that is not empty touches this range where min <= highest_min and max >= lowest_max.
  struct Window {
    std::uint16_t highest_min, lowest_max;
  };
  /// One for each range that some interval can touch.
  const std::vector<Window>& windows() const { return windows_; }

  /// Number of ranges that end below value(q).
  std::uint8_t below(std::uint16_t q) const { return below_[q]; }
  /// Number of ranges that begin at or below value(q).
  std::uint8_t up_to(std::uint16_t q) const { return up_to_[q]; }
  bool touches(std::uint16_t min, std::uint16_t max) const { return min <= max && up_to(max) > below(min); }

 private:
  std::vector<Window> windows_;
  std::vector<std::uint8_t> below_, up_to_;
};

}  // namespace quincunx

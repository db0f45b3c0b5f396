#include "spline/value_unit.h"

#include <algorithm>
#include <cmath>

namespace quincunx {
namespace {

constexpr double kFarFromZero = 8.0;          // the middle of the samples, in halves of their range
constexpr int kLeast = -40, kMost = 60;       // exponents of the largest number that is left as it is

}  // namespace

ValueUnit float_unit(SampleType type, double low, double high) {
  ValueUnit unit;
  if (type != SampleType::float32) return unit;  // floats hold every integer of 16 bits
  const double middle = 0.5 * low + 0.5 * high, half = 0.5 * high - 0.5 * low;
  if (std::abs(middle) > kFarFromZero * half) unit.offset = middle;
  const double largest = std::max(std::abs(low - unit.offset), std::abs(high - unit.offset));
  if (largest == 0.0) return unit;
  const int exponent = std::ilogb(largest);
  if (exponent < kLeast || exponent > kMost) unit.scale = std::ldexp(1.0, exponent);
  return unit;
}

}  // namespace quincunx

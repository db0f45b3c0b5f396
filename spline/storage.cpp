// Rounding to the formats.
//
// What a kernel decodes is fl(offset + fl(scale n')), with n' a number as the device reads it. Let e = 2^-24. 16-bit floats are read exactly; of a
// unorm the device's n / (2^bits - 1) is supposed to be within 2 e of it, relatively (tests/render/device_storage_test.cpp reads all of them). The
// number is at most half a step from the one that was meant, and with M the largest |value|, scale at most 2 M (1 + 2 e) and the product too, the
// roundings are 4 e M, 2 e M and 2 e M: storage_error says 16 e M, and 2^-110 for what is flushed to zero.
#include "spline/storage.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace quincunx {
namespace {

constexpr double kMostHalf = 32752.0;  // 2047 * 2^4
constexpr std::int64_t kGrain = 1 << 14;

double last_code(Storage storage) { return storage == Storage::unorm8 ? 255.0 : 65535.0; }

/// The least float that is not below x.
float ceiling(double x) {
  const float f = float(x);
  return double(f) < x ? std::nextafter(f, std::numeric_limits<float>::max()) : f;
}

std::uint16_t half_bits(double number) {
  const std::uint16_t sign = std::signbit(number) ? 0x8000 : 0;
  const double size = std::abs(number);
  if (size < 0x1p-14) return sign | (size >= 0x1p-15 ? 0x0400 : 0);
  if (size >= 65504.0) return sign | 0x7bff;
  // To 10 bits of the fraction, to nearest, ties to even: a carry into the exponent is right as it is.
  std::uint64_t bits = std::bit_cast<std::uint64_t>(size);
  bits += (std::uint64_t(1) << 41) - 1 + (bits >> 42 & 1);
  const std::uint16_t half = std::uint16_t((bits >> 42) - (std::uint64_t(1023 - 15) << 10));
  return sign | std::min<std::uint16_t>(half, 0x7bff);
}

float half_number(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const float size = exponent == 0 ? 0.0f : std::ldexp(float(1024 + (bits & 1023)), exponent - 25);
  return bits & 0x8000 ? -size : size;
}

}  // namespace

ValueUnit storage_unit(Storage storage, double low, double high) {
  assert(low <= high);
  if (storage == Storage::float32) return {};
  ValueUnit unit;
  unit.offset = storage == Storage::float16 ? double(float(0.5 * low + 0.5 * high)) : low;
  const double largest = std::max(high - unit.offset, unit.offset - low);
  if (largest > 0.0) unit.scale = double(ceiling(storage == Storage::float16 ? largest / kMostHalf : largest));
  return unit;
}

double storage_error(Storage storage, double low, double high) {
  if (storage == Storage::float32) return 0.0;
  const double roundings = 0x1p-20 * std::max(std::abs(low), std::abs(high)) + 0x1p-110;
  if (low == high) return roundings;
  const double half_step = storage == Storage::float16 ? 8.0 : 0.5 / last_code(storage);
  return half_step * storage_unit(storage, low, high).scale + roundings;
}

std::uint16_t storage_bits(Storage storage, double number) {
  assert(storage != Storage::float32);
  if (storage == Storage::float16) return half_bits(number);
  return std::uint16_t(std::clamp(number, 0.0, 1.0) * last_code(storage) + 0.5);
}

float stored_number(Storage storage, std::uint16_t bits) {
  return storage == Storage::float16 ? half_number(bits) : float(double(bits) / last_code(storage));
}

void pack(Storage storage, const ValueUnit& unit, std::span<const float> values, std::span<std::byte> packed) {
  const std::size_t bytes = std::size_t(storage_bytes(storage));
  assert(storage != Storage::float32 && packed.size() == bytes * values.size());
  using Blocks = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Blocks(0, values.size(), kGrain), [&](const Blocks& block) {
    for (std::size_t n = block.begin(); n != block.end(); ++n) {
      const std::uint16_t bits = storage_bits(storage, unit.number(double(values[n])));
      if (bytes == 1) {
        packed[n] = std::byte(bits);
      } else {
        std::memcpy(packed.data() + 2 * n, &bits, 2);
      }
    }
  });
}

std::vector<std::byte> store(Storage storage, Coefficients<float>& c) {
  if (storage == Storage::float32) return {};
  const std::size_t bytes = std::size_t(storage_bytes(storage));
  const NumberRange range = range_of(c.data);
  const ValueUnit unit = storage_unit(storage, range.low, range.high);
  std::vector<std::byte> packed(bytes * c.data.size());
  pack(storage, unit, c.data, packed);
  using Blocks = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Blocks(0, c.data.size(), kGrain), [&](const Blocks& block) {
    for (std::size_t n = block.begin(); n != block.end(); ++n) {
      std::uint16_t bits = std::uint16_t(packed[n * bytes]);
      if (bytes == 2) std::memcpy(&bits, packed.data() + 2 * n, 2);
      c.data[n] = stored_number(storage, bits);
    }
  });
  c.unit = {c.unit.value(unit.offset), c.unit.scale * unit.scale};
  return packed;
}

NumberRange range_of(std::span<const float> numbers) {
  assert(!numbers.empty());
  using Blocks = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Blocks(0, numbers.size(), kGrain), NumberRange{numbers[0], numbers[0]},
      [&](const Blocks& block, NumberRange r) {
        float low = r.low, high = r.high;
        for (std::size_t n = block.begin(); n != block.end(); ++n) {
          low = numbers[n] < low ? numbers[n] : low;
          high = numbers[n] > high ? numbers[n] : high;
        }
        return NumberRange{low, high};
      },
      [](const NumberRange& a, const NumberRange& b) { return NumberRange{std::min(a.low, b.low), std::max(a.high, b.high)}; });
}

Coefficients<float> stored_coefficients(const Spline& spline, const Volume& volume, Spline::Prefilter prefilter, Storage storage, const Progress& progress,
                                        std::vector<std::byte>* packed) {
  const SampleRange range = sample_range(volume);
  Coefficients<float> c = spline.coefficients_float(volume, prefilter, float_unit(volume.type(), range.min, range.max), progress);
  std::vector<std::byte> bits = store(storage, c);
  if (packed) *packed = std::move(bits);
  return c;
}

Coefficients<double> values_of(const Coefficients<float>& c) {
  Coefficients<double> values{c.lattice, c.extents, c.apron, c.world, std::vector<double>(c.data.size()), {}};
  for (std::size_t n = 0; n < c.data.size(); ++n) values.data[n] = c.unit.value(double(c.data[n]));
  return values;
}

}  // namespace quincunx

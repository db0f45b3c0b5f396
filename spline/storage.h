// The formats that coefficients may be stored in on a device, and what becomes of them there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "spline/spline.h"

namespace quincunx {

/// Numbers of a format:
///   float32   32-bit floats
///   float16   16-bit floats (IEEE 754 binary16), without subnormal ones, which devices may read as 0
///   unorm16   n / 65535, 0 <= n <= 65535
///   unorm8    n / 255,   0 <= n <= 255
enum class Storage { float32, float16, unorm16, unorm8 };

constexpr Storage kStorages[] = {Storage::float32, Storage::float16, Storage::unorm16, Storage::unorm8};

/// As --storage names it.
constexpr const char* storage_name(Storage storage) {
  switch (storage) {
    case Storage::float32: return "float32";
    case Storage::float16: return "float16";
    case Storage::unorm16: return "unorm16";
    case Storage::unorm8: break;
  }
  return "unorm8";
}

/// Bytes of a number.
constexpr std::uint64_t storage_bytes(Storage storage) { return storage == Storage::float32 ? 4 : storage == Storage::unorm8 ? 1 : 2; }

/// The unit whose numbers of the format hold values from `low` to `high` (floats) best: of unorm, 0 stands for `low` and 1 for `high`; of float16, 0 for
/// their middle and -32752 and 32752, half of the largest number, for the ends. Plain for float32. Offset and scale are floats, so that a kernel
/// may decode in floats. Both ends equal: the offset is that value, and is stored as 0.
ValueUnit storage_unit(Storage storage, double low, double high);

/// How far what a kernel decodes, in floats, of a value between `low` and `high` may be from it, where it is stored in the unit of these two: half a step of
/// the format, and the decoding's roundings. Grows with the interval.
double storage_error(Storage storage, double low, double high);

/// The bits of the format's number that is nearest to `number`; beyond its ends, that of the end. Not for float32.
std::uint16_t storage_bits(Storage storage, double number);
/// The number, rounded to a float.
float stored_number(Storage storage, std::uint16_t bits);

/// Writes values in `unit` as the bits of numbers, storage_bytes each, in the machine's byte order. Not for float32.
void pack(Storage storage, const ValueUnit& unit, std::span<const float> values, std::span<std::byte> packed);

/// Makes of coefficients what they are once stored, in their storage_unit, and gives the bits of that; for float32 nothing happens, and there are none.
std::vector<std::byte> store(Storage storage, Coefficients<float>& c);

/// The least and the largest of some numbers, at least one.
struct NumberRange {
  float low = 0.0f, high = 0.0f;
};
NumberRange range_of(std::span<const float> numbers);

/// The values that the numbers stand for.
Coefficients<double> values_of(const Coefficients<float>& c);

/// The coefficients that kernels of 32-bit floats are given of a volume: what the prefilter makes, rounded to floats in float_unit, then to `storage`, whose bits
/// `packed` gets where it is not null (none for float32). Throws as Spline::coefficients_float.
Coefficients<float> stored_coefficients(const Spline& spline, const Volume& volume, Spline::Prefilter prefilter, Storage storage, const Progress& progress = {},
                                        std::vector<std::byte>* packed = nullptr);

}  // namespace quincunx

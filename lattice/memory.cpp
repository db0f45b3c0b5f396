#include "lattice/memory.h"

#include <fmt/format.h>
#include <unistd.h>

#include "lattice/error.h"

namespace quincunx {

std::uint64_t checked_sample_count(LatticeKind lattice, const Extents& extents, SampleType type,
                                   std::string_view what) {
  constexpr std::uint64_t max_bytes = std::uint64_t(1) << 62;
  std::uint64_t count = std::uint64_t(coset_count(lattice));
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t n = extents[axis];
    if (n < 1) {
      throw InputError(fmt::format("{}: extents {} x {} x {}, expected at least 1 on every axis", what, extents.x,
                                   extents.y, extents.z));
    }
    if (std::uint64_t(n) > max_bytes / sample_type_bytes(type) / count) {
      throw InputError(
          fmt::format("{}: extents {} x {} x {} are more samples than can be counted, expected fewer than "
                      "2^62 bytes",
                      what, extents.x, extents.y, extents.z));
    }
    count *= std::uint64_t(n);
  }
  return count;
}

std::uint64_t memory_bytes() { return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGE_SIZE)); }

void check_fits_memory(std::uint64_t bytes, std::string_view what) {
  const std::uint64_t memory = memory_bytes();
  if (bytes <= memory) return;
  throw InputError(fmt::format("{}: needs {:.1f} GiB, expected at most this machine's memory of {:.1f} GiB", what,
                               double(bytes) / double(1 << 30), double(memory) / double(1 << 30)));
}

}  // namespace quincunx

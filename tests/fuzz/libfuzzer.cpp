// What libFuzzer calls: one program for each reader, whose function QUINCUNX_FEED is.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  quincunx::fuzz::QUINCUNX_FEED({reinterpret_cast<const char*>(bytes), size});
  return 0;
}

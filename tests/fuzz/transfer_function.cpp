#include "render/transfer_function.h"

#include <cmath>

#include "tests/fuzz/expect.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/targets.h"

namespace quincunx::fuzz {
namespace {

/// Rounding may lead beyond both ends by so much.
bool is_part(double x) { return x >= -1e-12 && x <= 1.0 + 1e-12; }

}  // namespace

void feed_transfer_function(std::string_view input) {
  static MemoryFile file(900);
  file.write(input);
  accepts(file.path(), [&] {
    const TransferFunction function = read_transfer_function(file.path());
    const double low = function.low(), high = function.high();
    expect(std::isfinite(low) && low < high, "a range of values");
    for (int n = -1; n <= 17; ++n) {
      const double value = std::lerp(low, high, n / 16.0);
      const glm::dvec3 c = function.color(value);
      expect(is_part(c.r) && is_part(c.g) && is_part(c.b) && is_part(function.opacity(value)), "colours and opacities of 0..1");
    }
  });
}

}  // namespace quincunx::fuzz

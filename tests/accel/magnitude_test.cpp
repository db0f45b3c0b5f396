#include "accel/magnitude.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coefficient_sets.h"

namespace quincunx {
namespace {

/// The largest |coefficient|, coefficient or -coefficient at lattice points u, low <= u <= high, by walking all of them. Beyond the apron there are
/// none.
float largest(const Coefficients<float>& c, Magnitudes::Of of, const glm::i64vec3& low, const glm::i64vec3& high) {
  float found = std::numeric_limits<float>::lowest();
  for (std::int64_t z = low.z; z <= high.z; ++z)
    for (std::int64_t y = low.y; y <= high.y; ++y)
      for (std::int64_t x = low.x; x <= high.x; ++x) {
        const std::int64_t coset = x & 1;
        if ((y & 1) != coset || (z & 1) != coset) continue;
        const glm::i64vec3 p = (glm::i64vec3(x, y, z) - coset) / std::int64_t(2);
        if (glm::any(glm::lessThan(p, glm::i64vec3(-c.apron))) ||
            glm::any(glm::greaterThanEqual(p, c.extents + std::int64_t(c.apron))))
          continue;
        const float f = c.data[c.number(int(coset), p)];
        found = std::max(found, of == Magnitudes::Of::absolute ? std::abs(f) : of == Magnitudes::Of::value ? f : -f);
      }
  return found;
}

/// What is asked for, and within which lattice points of the cells 2i..2i+1 it has to look.
struct Asked {
  Magnitudes::Near near;
  Magnitudes::Of of;
  std::int64_t least_low, least_high;  // it looks at all from 2i - least_low to 2i + least_high
};
class MagnitudesOf : public testing::TestWithParam<Asked> {};

TEST_P(MagnitudesOf, CoverTheSamplesOfACellAndItsNeighboursAndLittleMore) {
  for (const CoefficientSet& set : coefficient_sets()) {
    const auto& [near, of, least_low, least_high] = GetParam();
    const glm::i64vec3 cells = domain_max(set.c.lattice, set.c.extents);
    Magnitudes magnitudes;
    // In boxes of rows, as tiles ask for them.
    for (std::int64_t k0 = 0; k0 < set.c.extents.z; k0 += 4)
      for (std::int64_t j0 = 0; j0 < set.c.extents.y; j0 += 4) {
        const std::int64_t count_j = std::min<std::int64_t>(4, set.c.extents.y - j0),
                           count_k = std::min<std::int64_t>(4, set.c.extents.z - k0);
        magnitudes.compute(set.c, near, of, j0, count_j, k0, count_k);
        for (std::int64_t k = k0; k < k0 + count_k; ++k)
          for (std::int64_t j = j0; j < j0 + count_j; ++j)
            for (std::int64_t i = 0; i < set.c.extents.x; ++i) {
              const glm::i64vec3 even = 2L * glm::i64vec3(i, j, k);
              // Of the far border's cells there may be one.
              const glm::i64vec3 last = glm::min(even + 1L, cells - 1L);
              const float m = magnitudes.row(j, k)[i];
              ASSERT_GE(m, largest(set.c, of, even - least_low, last + (least_high - 1L))) << set.name;
              ASSERT_LE(m, largest(set.c, of, even - 2L * near.before, even + 2L * near.after + 1L)) << set.name;
            }
      }
  }
}

// bcc4, bcc7, bcc8: cells X are reached from X-1..X+2, X-2..X+3, X-3..X+4, their neighbours from one further.
INSTANTIATE_TEST_SUITE_P(Splines, MagnitudesOf,
                         testing::Values(Asked{{1, 2}, Magnitudes::Of::value, 2, 4}, Asked{{1, 2}, Magnitudes::Of::negative, 2, 4},
                                         Asked{{2, 2}, Magnitudes::Of::absolute, 3, 5}, Asked{{2, 3}, Magnitudes::Of::absolute, 4, 6}));

}  // namespace
}  // namespace quincunx

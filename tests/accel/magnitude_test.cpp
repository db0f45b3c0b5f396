#include "accel/magnitude.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coefficient_sets.h"

namespace quincunx {
namespace {

/// The largest |coefficient| at lattice points u, low <= u <= high, by walking all of them. Beyond the apron there are
/// none.
float largest(const Coefficients<float>& c, const glm::i64vec3& low, const glm::i64vec3& high) {
  float found = 0.0f;
  for (std::int64_t z = low.z; z <= high.z; ++z)
    for (std::int64_t y = low.y; y <= high.y; ++y)
      for (std::int64_t x = low.x; x <= high.x; ++x) {
        const std::int64_t coset = x & 1;
        if ((y & 1) != coset || (z & 1) != coset) continue;
        const glm::i64vec3 p = (glm::i64vec3(x, y, z) - coset) / std::int64_t(2);
        if (glm::any(glm::lessThan(p, glm::i64vec3(-c.apron))) ||
            glm::any(glm::greaterThanEqual(p, c.extents + std::int64_t(c.apron))))
          continue;
        found = std::max(found, std::abs(c.data[c.number(int(coset), p)]));
      }
  return found;
}

TEST(Magnitudes, CoverTheSamplesOfACellAndItsNeighboursAndLittleMore) {
  for (const CoefficientSet& set : coefficient_sets()) {
    const glm::i64vec3 cells = domain_max(set.c.lattice, set.c.extents);
    Magnitudes magnitudes, wide(3);
    // In boxes of rows, as tiles ask for them.
    for (std::int64_t k0 = 0; k0 < set.c.extents.z; k0 += 4)
      for (std::int64_t j0 = 0; j0 < set.c.extents.y; j0 += 4) {
        const std::int64_t count_j = std::min<std::int64_t>(4, set.c.extents.y - j0),
                           count_k = std::min<std::int64_t>(4, set.c.extents.z - k0);
        magnitudes.compute(set.c, j0, count_j, k0, count_k);
        wide.compute(set.c, j0, count_j, k0, count_k);
        for (std::int64_t k = k0; k < k0 + count_k; ++k)
          for (std::int64_t j = j0; j < j0 + count_j; ++j)
            for (std::int64_t i = 0; i < set.c.extents.x; ++i) {
              const glm::i64vec3 even = 2L * glm::i64vec3(i, j, k);
              const glm::i64vec3 last = glm::min(even + 1L, cells - 1L);
              const float m = magnitudes.row(j, k)[i];
              ASSERT_GE(m, largest(set.c, even - 3L, last + 4L)) << set.name;
              ASSERT_LE(m, largest(set.c, even - 4L, even + 5L)) << set.name;
              ASSERT_GE(wide.row(j, k)[i], largest(set.c, even - 4L, last + 5L)) << set.name;
              ASSERT_LE(wide.row(j, k)[i], largest(set.c, even - 6L, even + 7L)) << set.name;
            }
      }
  }
}

}  // namespace
}  // namespace quincunx

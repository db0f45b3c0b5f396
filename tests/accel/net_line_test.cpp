#include "accel/net_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coefficient_sets.h"
#include "spline/bcc7_net.h"

namespace quincunx {
namespace {

/// The net at q (quarter units) by its definition, in double.
double net_at(const Coefficients<float>& c, const glm::i64vec3& q) {
  double sum = 0.0;
  for (int coset = 0; coset < 2; ++coset)
    for (std::int64_t k = -1; k <= c.extents.z; ++k)
      for (std::int64_t j = -1; j <= c.extents.y; ++j)
        for (std::int64_t i = -1; i <= c.extents.x; ++i) {
          const glm::ivec3 d(q - 8L * glm::i64vec3(i, j, k) - 4L * coset);
          if (const int w = bcc7_net(d.x, d.y, d.z); w != 0) sum += w * double(c.data[c.number(coset, {i, j, k})]);
        }
  return sum / kBcc7NetDenominator;
}

TEST(NetLines, HoldTheRangeOfTheNetOverTheClosedEdgeOfEachCellWithinTheStatedError) {
  for (const CoefficientSet& set : coefficient_sets()) {
    if (set.c.extents.x * set.c.extents.y * set.c.extents.z > 500) continue;
    const glm::i64vec3 cells = domain_max(set.c.lattice, set.c.extents);
    double magnitude = 0.0;
    for (float v : set.c.data) magnitude = std::max(magnitude, std::abs(double(v)));
    const NetLines lines(set.c);
    NetLines::Workspace work = lines.workspace();
    // Every residue of (y,z), near the far border where the apron is needed, and the first lines.
    for (std::int64_t z : {0L, 1L, 2L, 3L, 4 * cells.z - 3, 4 * cells.z - 2, 4 * cells.z - 1, 4 * cells.z})
      for (std::int64_t y : {0L, 1L, 2L, 3L, 4 * cells.y - 3, 4 * cells.y - 2, 4 * cells.y - 1, 4 * cells.y}) {
        RowRange found = lines.empty_range();
        RowRange* rows[] = {&found};
        lines.widen(y, z, work, rows, 1);
        for (std::int64_t x = 0; x < cells.x; ++x) {
          double low = std::numeric_limits<double>::max(), high = -low;
          for (int a = 0; a <= 4; ++a) {
            const double f = net_at(set.c, {4 * x + a, y, z});
            low = std::min(low, f), high = std::max(high, f);
          }
          const std::size_t n = std::size_t(x % 2 * found.pitch + x / 2);
          ASSERT_NEAR(found.min[n], low, 32 * 0x1p-24 * magnitude) << set.name << ' ' << x << ' ' << y << ' ' << z;
          ASSERT_NEAR(found.max[n], high, 32 * 0x1p-24 * magnitude) << set.name << ' ' << x << ' ' << y << ' ' << z;
        }
      }
  }
}

TEST(NetLines, AreTheSameToTheBitWithAndWithoutVectorInstructionsOfTheProcessor) {
  const Coefficients<float> c = smooth_coefficients({90, 4, 4});
  const NetLines best(c), portable(c, NetLines::Instructions::portable);
  NetLines::Workspace work = best.workspace();
  for (std::int64_t z = 4; z < 12; ++z)
    for (std::int64_t y = 4; y < 12; ++y) {
      RowRange a = best.empty_range(), b = a;
      RowRange *rows_a[] = {&a}, *rows_b[] = {&b};
      best.widen(y, z, work, rows_a, 1);
      portable.widen(y, z, work, rows_b, 1);
      ASSERT_EQ(a.min, b.min);
      ASSERT_EQ(a.max, b.max);
    }
}

}  // namespace
}  // namespace quincunx

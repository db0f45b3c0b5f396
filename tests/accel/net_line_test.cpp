#include "accel/net_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "coefficient_sets.h"
#include "spline/bcc4_net.h"
#include "spline/bcc7_net.h"
#include "spline/bcc8_net.h"

namespace quincunx {
namespace {

/// The net at q (n-ths) by its definition, in double.
double net_at(const NetView& net, const Coefficients<float>& c, const glm::i64vec3& q) {
  // The samples that may reach q: within 3 of it in each coset.
  const glm::i64vec3 about = q / std::int64_t(2 * net.degree), low = glm::max(about - 3L, glm::i64vec3(-c.apron)),
                     high = glm::min(about + 3L, c.extents + std::int64_t(c.apron - 1));
  double sum = 0.0;
  for (int coset = 0; coset < 2; ++coset)
    for (std::int64_t k = low.z; k <= high.z; ++k)
      for (std::int64_t j = low.y; j <= high.y; ++j)
        for (std::int64_t i = low.x; i <= high.x; ++i) {
          const glm::ivec3 d(q - std::int64_t(net.degree) * (2L * glm::i64vec3(i, j, k) + std::int64_t(coset)));
          if (const int w = net.at(d.x, d.y, d.z); w != 0) sum += w * double(c.data[c.number(coset, {i, j, k})]);
        }
  return sum / net.denominator;
}

class NetLinesOf : public testing::TestWithParam<NetView> {};

TEST_P(NetLinesOf, HoldTheRangeOfTheNetOverTheClosedEdgeOfEachCellWithinTheStatedError) {
  const NetView& net = GetParam();
  const std::int64_t n = net.degree;
  for (const CoefficientSet& set : coefficient_sets()) {
    if (set.c.extents.x * set.c.extents.y * set.c.extents.z > 500) continue;
    const glm::i64vec3 cells = domain_max(set.c.lattice, set.c.extents);
    double magnitude = 0.0;
    for (float v : set.c.data) magnitude = std::max(magnitude, std::abs(double(v)));
    const NetLines lines(set.c, net);
    NetLines::Workspace work = lines.workspace();
    // Every residue of (y,z), near the far border where the apron is needed, and the first lines.
    std::vector<std::int64_t> ends[2];
    for (int a = 0; a < 2; ++a)
      for (std::int64_t r = 0; r < n; ++r) ends[a].push_back(r), ends[a].push_back(n * cells[a + 1] - r);
    for (std::int64_t z : ends[1])
      for (std::int64_t y : ends[0]) {
        RowRange found = lines.empty_range();
        RowRange* rows[] = {&found};
        lines.widen(y, z, work, rows, 1);
        for (std::int64_t x = 0; x < cells.x; ++x) {
          double low = std::numeric_limits<double>::max(), high = -low;
          for (int a = 0; a <= n; ++a) {
            const double f = net_at(net, set.c, {n * x + a, y, z});
            low = std::min(low, f), high = std::max(high, f);
          }
          const std::size_t at = std::size_t(x % 2 * found.pitch + x / 2);
          ASSERT_NEAR(found.min[at], low, 32 * 0x1p-24 * magnitude) << set.name << ' ' << x << ' ' << y << ' ' << z;
          ASSERT_NEAR(found.max[at], high, 32 * 0x1p-24 * magnitude) << set.name << ' ' << x << ' ' << y << ' ' << z;
        }
      }
  }
}

TEST_P(NetLinesOf, AreTheSameToTheBitWithAndWithoutVectorInstructionsOfTheProcessor) {
  const Coefficients<float> c = smooth_coefficients({90, 4, 4});
  const NetLines best(c, GetParam()), portable(c, GetParam(), NetLines::Instructions::portable);
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

INSTANTIATE_TEST_SUITE_P(Degrees, NetLinesOf, testing::Values(kNetView<kBcc4Net>, kNetView<kBcc7Net>, kNetView<kBcc8Net>),
                         [](const auto& instance) { return std::to_string(instance.param.degree); });

}  // namespace
}  // namespace quincunx

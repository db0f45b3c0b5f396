#include "spline/tetrahedron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

TEST(Tetrahedron, WalksFromTheEvenCornerToTheOddOneAlongTheEdgesOfTheCell) {
  Random random(1);
  for (int n = 0; n < 200; ++n) {
    const glm::dvec3 u = random.point(glm::dvec3(-5.0), glm::dvec3(5.0));
    const glm::ivec3 cell(glm::floor(u));
    const Tetrahedron t = locate(cell, u);
    EXPECT_EQ(t.vertex(0) & 1, glm::ivec3(0));
    EXPECT_EQ(t.vertex(3) & 1, glm::ivec3(1));
    for (int i = 0; i < 4; ++i) {
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(t.vertex(i), cell)) &&
                  glm::all(glm::lessThanEqual(t.vertex(i), cell + 1)));
      if (i == 0) continue;
      const glm::ivec3 step = glm::abs(t.vertex(i) - t.vertex(i - 1));
      EXPECT_EQ(step.x + step.y + step.z, 1);
    }
  }
}

TEST(Tetrahedron, HoldsThePointItWasLocatedFor) {
  Random random(2);
  for (int n = 0; n < 1000; ++n) {
    glm::dvec3 u = random.point(glm::dvec3(-5.0), glm::dvec3(5.0));
    if (n % 3 == 1) u = glm::round(u * 2.0) / 2.0;  // faces, edges and vertices
    const Tetrahedron t = locate(glm::ivec3(glm::floor(u)), u);
    const glm::dvec4 b = t.barycentric(u);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 4; ++i) {
      EXPECT_GE(b[i], 0.0);
      sum += b[i] * glm::dvec3(t.vertex(i));
    }
    EXPECT_LT(glm::distance(sum, u), 1e-14);
  }
}

TEST(Tetrahedron, IsTheSameSetAfterAShiftByALatticePointOnFacesToo) {
  Random random(4);
  for (int n = 0; n < 1000; ++n) {
    const glm::dvec3 u = glm::round(random.point(glm::dvec3(-5.0), glm::dvec3(5.0)) * 4.0) / 4.0;
    const int coset = n & 1;
    const glm::ivec3 shift = 2 * glm::ivec3(random.point(glm::dvec3(-4.0), glm::dvec3(4.0))) + coset;
    const Tetrahedron t = locate(glm::ivec3(glm::floor(u)), u), moved = locate(glm::ivec3(glm::floor(u)) + shift, u + glm::dvec3(shift));
    for (int i = 0; i < 4; ++i) EXPECT_EQ(moved.vertex(i), t.vertex(coset ? 3 - i : i) + shift) << u.x << ' ' << u.y << ' ' << u.z;
  }
}

TEST(Tetrahedron, ComesIn24KindsOfWhichEveryCellHasSix) {
  Random random(3);
  std::set<std::vector<int>> kinds;
  for (int n = 0; n < 3000; ++n) {
    const glm::dvec3 u = random.point(glm::dvec3(0.0), glm::dvec3(2.0));
    const glm::ivec3 cell(glm::floor(u));
    const Tetrahedron t = locate(cell, u);
    // The parity of the cell up to lattice translations decides the signs.
    const int flip = t.sign.x;
    kinds.insert({t.sign.y * flip, t.sign.z * flip, flip, t.axis.x, t.axis.y, t.axis.z});
  }
  EXPECT_EQ(kinds.size(), 48u);  // each kind from its even end and, translated by (1,1,1), from its odd end
}

TEST(Tetrahedron, IsNearestByOrderForPointsOutsideTheCell) {
  const Tetrahedron t = locate({0, 0, 0}, {1.5, -0.5, 0.5});
  EXPECT_EQ(t.axis, glm::ivec3(0, 2, 1));
}

}  // namespace
}  // namespace quincunx

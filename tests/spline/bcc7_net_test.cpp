// The Bernstein-Bezier net of M7, in integers.
#include "spline/bcc7_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "spline/tetrahedron.h"

namespace quincunx {
namespace {

int net(const glm::ivec3& q) { return bcc7_net(q.x, q.y, q.z); }

int factorial(int n) { return n <= 1 ? 1 : n * factorial(n - 1); }

/// The tetrahedra of the cells within `radius` of the origin.
std::vector<Tetrahedron> tetrahedra(int radius) {
  std::vector<Tetrahedron> list;
  for (int x = -radius; x < radius; ++x)
    for (int y = -radius; y < radius; ++y)
      for (int z = -radius; z < radius; ++z) {
        const glm::ivec3 cell(x, y, z), odd = cell & 1;
        glm::ivec3 axis(0, 1, 2);
        do list.push_back({cell + odd, 1 - 2 * odd, axis});
        while (std::next_permutation(&axis.x, &axis.x + 3));
      }
  return list;
}

/// A face between two tetrahedra: its vertices and the two opposite ones.
struct Face {
  std::array<glm::ivec3, 3> corners;
  glm::ivec3 one, other;
};

std::vector<Face> inner_faces(const std::vector<Tetrahedron>& list) {
  const auto less = [](const glm::ivec3& a, const glm::ivec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  const auto faces_less = [&](const std::array<glm::ivec3, 3>& a, const std::array<glm::ivec3, 3>& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  };
  std::map<std::array<glm::ivec3, 3>, glm::ivec3, decltype(faces_less)> open(faces_less);
  std::vector<Face> faces;
  for (const Tetrahedron& t : list)
    for (int opposite = 0; opposite < 4; ++opposite) {
      std::array<glm::ivec3, 3> corners;
      for (int i = 0, n = 0; i < 4; ++i)
        if (i != opposite) corners[n++] = t.vertex(i);
      std::sort(corners.begin(), corners.end(), less);
      if (const auto found = open.find(corners); found != open.end())
        faces.push_back({corners, found->second, t.vertex(opposite)});
      else
        open.emplace(corners, t.vertex(opposite));
    }
  return faces;
}

int determinant(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

/// Barycentric coordinates of face.other with respect to (face.one, corners): integers, as all volumes are equal.
std::array<int, 4> barycentric(const Face& face) {
  const auto& [a, b, c] = face.corners;
  const int volume = determinant(a - face.one, b - face.one, c - face.one);
  const glm::ivec3 d = face.other - face.one;
  const int ta = determinant(d, b - face.one, c - face.one) / volume;
  const int tb = determinant(a - face.one, d, c - face.one) / volume;
  const int tc = determinant(a - face.one, b - face.one, d) / volume;
  return {1 - ta - tb - tc, ta, tb, tc};
}

/// Whether the derivatives of order `order` across the face agree (G. Farin's conditions: the coefficients of one side
/// are polar forms of the other).
bool joins(const Face& face, int order) {
  const std::array<int, 4> tau = barycentric(face);
  for (int i = 0; i <= 4 - order; ++i)
    for (int j = 0; i + j <= 4 - order; ++j) {
      const glm::ivec3 on_face = i * face.corners[0] + j * face.corners[1] + (4 - order - i - j) * face.corners[2];
      int polar = 0;
      for (int g0 = 0; g0 <= order; ++g0)
        for (int g1 = 0; g0 + g1 <= order; ++g1)
          for (int g2 = 0; g0 + g1 + g2 <= order; ++g2) {
            const std::array<int, 4> g = {g0, g1, g2, order - g0 - g1 - g2};
            int factor = factorial(order);
            for (int k = 0; k < 4; ++k) {
              factor /= factorial(g[k]);
              for (int n = 0; n < g[k]; ++n) factor *= tau[k];
            }
            polar += factor * net(on_face + g[0] * face.one + g[1] * face.corners[0] + g[2] * face.corners[1] +
                                  g[3] * face.corners[2]);
          }
      if (polar != net(on_face + order * face.other)) return false;
    }
  return true;
}

/// The knot plane of a face by its normal's absolute values: "100" and so on.
std::string plane_of(const Face& face) {
  const glm::ivec3 a = face.corners[1] - face.corners[0], b = face.corners[2] - face.corners[0];
  const glm::ivec3 n = glm::abs(glm::ivec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x));
  return std::to_string(n.x) + std::to_string(n.y) + std::to_string(n.z);
}

TEST(Bcc7Net, JoinsC3AcrossTheFacesOfCellsAndC2AcrossTheOthersAndNoSmoother) {
  // 5 of the 7 directions leave a plane x = 0, 4 leave a plane x = y: so many less 2 derivatives agree.
  const std::map<std::string, int> smoothness = {{"100", 3}, {"010", 3}, {"001", 3},
                                                 {"110", 2}, {"101", 2}, {"011", 2}};
  std::map<std::string, int> faces, broken;
  for (const Face& face : inner_faces(tetrahedra(4))) {
    const std::string plane = plane_of(face);
    ASSERT_TRUE(smoothness.count(plane)) << plane;
    for (int order = 0; order <= smoothness.at(plane); ++order)
      ASSERT_TRUE(joins(face, order)) << plane << " order " << order;
    ++faces[plane];
    broken[plane] += !joins(face, smoothness.at(plane) + 1);
  }
  for (const auto& [plane, order] : smoothness) {
    EXPECT_GT(faces[plane], 100) << plane;
    EXPECT_GT(broken[plane], 0) << plane;
  }
}

TEST(Bcc7Net, HoldsAPartitionOfUnityAtEveryQuarterPoint) {
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) {
        int sum = 0;
        for (int i = -4; i <= 4; ++i)
          for (int j = -4; j <= 4; ++j)
            for (int k = -4; k <= 4; ++k)
              if ((i - j) % 2 == 0 && (j - k) % 2 == 0) sum += bcc7_net(x - 4 * i, y - 4 * j, z - 4 * k);
        EXPECT_EQ(sum, kBcc7NetDenominator);
      }
}

TEST(Bcc7Net, Has115PositiveOrbitsWithTheKnownValuesAmongThem) {
  EXPECT_EQ(std::size(kBcc7NetOrbits), 115u);
  for (const Bcc7NetOrbit& q : kBcc7NetOrbits) {
    EXPECT_GT(q.numerator, 0);
    EXPECT_TRUE(q.i >= q.j && q.j >= q.k && q.k >= 0);
    EXPECT_EQ(bcc7_net(-q.k, q.i, -q.j), q.numerator);
  }
  EXPECT_EQ(bcc7_net(0, 0, 0), 144);
  EXPECT_EQ(bcc7_net(kBcc7NetReach + 1, 0, 0), 0);
  EXPECT_EQ(bcc7_net(100, -100, 100), 0);
}

}  // namespace
}  // namespace quincunx

// The Bernstein-Bezier nets of the BCC lattice's box splines, in integers.
#include "spline/box_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "spline/bcc4_net.h"
#include "spline/bcc7_net.h"
#include "spline/bcc8_net.h"
#include "spline/tetrahedron.h"

namespace quincunx {
namespace {

/// A spline's net and what is known of it.
struct NetOf {
  std::string name;
  int degree, denominator, reach;
  int (*at)(int i, int j, int k);
  std::span<const NetOrbit> orbits;
  std::size_t orbit_count;
  int at_origin;
  int across_cells, inside_cells;  // derivatives that agree across the faces of cells, and across the planes inside them
};

template <const auto& kNet>
int value_of(int i, int j, int k) {
  return kNet(i, j, k);
}

// So many directions less 2 leave a plane as derivatives agree: of bcc7 5 leave x = 0 and 4 leave x = y; of bcc4 and bcc8 no two lie in
// x = 0, which so is no knot plane, and 2 and 4 leave x = y.
const NetOf kNets[] = {
    {"bcc4", 1, kBcc4Net.denominator, kBcc4Net.reach, value_of<kBcc4Net>, kBcc4NetOrbits, 2, 2, 1, 0},
    {"bcc7", 4, kBcc7Net.denominator, kBcc7Net.reach, value_of<kBcc7Net>, kBcc7NetOrbits, 115, 144, 3, 2},
    {"bcc8", 5, kBcc8Net.denominator, kBcc8Net.reach, value_of<kBcc8Net>, kBcc8NetOrbits, 268, 768, 5, 2},
};

class Net : public testing::TestWithParam<NetOf> {};

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
bool joins(const NetOf& spline, const Face& face, int order) {
  const std::array<int, 4> tau = barycentric(face);
  const auto net = [&](const glm::ivec3& q) { return spline.at(q.x, q.y, q.z); };
  const int rest = spline.degree - order;
  for (int i = 0; i <= rest; ++i)
    for (int j = 0; i + j <= rest; ++j) {
      const glm::ivec3 on_face = i * face.corners[0] + j * face.corners[1] + (rest - i - j) * face.corners[2];
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

TEST_P(Net, JoinsAsSmoothlyAsTheDirectionsThatLeaveAKnotPlaneSayAndNoSmoother) {
  const NetOf& spline = GetParam();
  std::map<std::string, int> faces, broken;
  for (const Face& face : inner_faces(tetrahedra(4))) {
    const std::string plane = plane_of(face);
    const int smoothness = std::count(plane.begin(), plane.end(), '1') == 1 ? spline.across_cells : spline.inside_cells;
    for (int order = 0; order <= smoothness; ++order) ASSERT_TRUE(joins(spline, face, order)) << plane << " order " << order;
    ++faces[plane];
    if (smoothness < spline.degree) broken[plane] += !joins(spline, face, smoothness + 1);
  }
  for (const std::string plane : {"100", "010", "001", "110", "101", "011"}) {
    EXPECT_GT(faces[plane], 100) << plane;
    const bool cell = std::count(plane.begin(), plane.end(), '1') == 1;
    EXPECT_EQ(broken[plane] > 0, !cell || spline.across_cells < spline.degree) << plane;
  }
}

TEST_P(Net, HoldsAPartitionOfUnityAtEveryPointOfItsGrid) {
  const NetOf& spline = GetParam();
  const int n = spline.degree;
  for (int x = 0; x < 2 * n; ++x)
    for (int y = 0; y < 2 * n; ++y)
      for (int z = 0; z < 2 * n; ++z) {
        int sum = 0;
        for (int i = -5; i <= 5; ++i)
          for (int j = -5; j <= 5; ++j)
            for (int k = -5; k <= 5; ++k)
              if ((i - j) % 2 == 0 && (j - k) % 2 == 0) sum += spline.at(x - n * i, y - n * j, z - n * k);
        EXPECT_EQ(sum, spline.denominator);
      }
}

TEST_P(Net, HasItsPositiveOrbitsWithTheKnownValueAtTheOrigin) {
  const NetOf& spline = GetParam();
  EXPECT_EQ(spline.orbits.size(), spline.orbit_count);
  for (const NetOrbit& q : spline.orbits) {
    EXPECT_GT(q.numerator, 0);
    EXPECT_TRUE(q.i >= q.j && q.j >= q.k && q.k >= 0);
    EXPECT_EQ(spline.at(-q.k, q.i, -q.j), q.numerator);
  }
  EXPECT_EQ(spline.at(0, 0, 0), spline.at_origin);
  EXPECT_EQ(spline.at(spline.reach + 1, 0, 0), 0);
  EXPECT_EQ(spline.at(100, -100, 100), 0);
}

INSTANTIATE_TEST_SUITE_P(All, Net, testing::ValuesIn(kNets), [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace quincunx

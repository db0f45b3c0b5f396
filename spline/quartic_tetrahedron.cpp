#include "spline/quartic_tetrahedron.h"

namespace quincunx {
namespace {

/// Numbers of the four coefficients that one step of de Casteljau's algorithm combines into the first of them.
struct Corners {
  int at[4];
};

constexpr std::array<Corners, 20> kCorners = [] {
  std::array<Corners, 20> corners{};
  int n = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k)
        corners[n++] = {{quartic_number(i, j, k), quartic_number(i + 1, j, k), quartic_number(i + 1, j + 1, k),
                         quartic_number(i + 1, j + 1, k + 1)}};
  return corners;
}();

/// Numbers of a net of degree 0..4.
constexpr int net_size(int degree) { return (degree + 1) * (degree + 2) * (degree + 3) / 6; }

/// The step for a degree known while compiling, so that it unrolls.
template <int Degree>
inline void step(const glm::dvec4& b, const double* from, double* to) {
  for (int n = 0; n < net_size(Degree - 1); ++n) {
    const int* at = kCorners[n].at;  // ascending: in place, nothing is read after it was written
    to[n] = b[0] * from[at[0]] + b[1] * from[at[1]] + b[2] * from[at[2]] + b[3] * from[at[3]];
  }
}

}  // namespace

QuarticJet evaluate_quartic(const QuarticNet& net, const glm::dvec4& b) {
  double c[20];
  step<4>(b, net.data(), c);
  step<3>(b, c, c);
  step<2>(b, c, c);
  QuarticJet jet;
  jet.derivatives = 4.0 * glm::dvec3(c[1] - c[0], c[2] - c[1], c[3] - c[2]);
  jet.value = b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3];
  return jet;
}

std::array<double, 5> restrict_quartic(const QuarticNet& net, const glm::dvec4& a, const glm::dvec4& b) {
  // Row m of each stage is the net with m of its arguments fixed at b, the others at a.
  double cubic[2][20], quadric[3][10], plane[4][4];
  step<4>(a, net.data(), cubic[0]);
  step<4>(b, net.data(), cubic[1]);
  step<3>(a, cubic[0], quadric[0]);
  step<3>(b, cubic[0], quadric[1]);
  step<3>(b, cubic[1], quadric[2]);
  for (int m = 0; m < 3; ++m) step<2>(a, quadric[m], plane[m]);
  step<2>(b, quadric[2], plane[3]);
  std::array<double, 5> bernstein;
  for (int m = 0; m < 4; ++m) step<1>(a, plane[m], &bernstein[m]);
  step<1>(b, plane[3], &bernstein[4]);
  return bernstein;
}

}  // namespace quincunx

// Polynomials on a tetrahedron in Bernstein-Bezier form.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>

namespace quincunx {

/// Bernstein coefficients of a polynomial of that degree on a tetrahedron.
constexpr int net_size(int degree) { return (degree + 1) * (degree + 2) * (degree + 3) / 6; }

/// Coefficient number net_number(i,j,k), n = Degree >= i >= j >= k >= 0, belongs to the point v0 + (i (v1-v0) + j (v2-v1) + k (v3-v2)) / n
/// of a tetrahedron v0..v3. The numbers do not depend on the degree: those of a lower one come first.
template <int Degree>
using TetrahedronNet = std::array<double, net_size(Degree)>;

constexpr int net_number(int i, int j, int k) { return i * (i + 1) * (i + 2) / 6 + j * (j + 1) / 2 + k; }

/// Value, and derivatives along v1-v0, v2-v1 and v3-v2, at a barycentric point.
struct TetrahedronJet {
  double value;
  glm::dvec3 derivatives;
};

/// The polynomial and its derivatives at the barycentric point `b`, by de Casteljau's algorithm.
template <int Degree>
TetrahedronJet evaluate_net(const TetrahedronNet<Degree>& net, const glm::dvec4& b);

/// The Degree + 1 Bernstein coefficients of the polynomial along the segment between the barycentric points `a` and `b`
/// (blossoming: coefficient m is the polar form at Degree - m times `a` and m times `b`).
template <int Degree>
std::array<double, Degree + 1> restrict_net(const TetrahedronNet<Degree>& net, const glm::dvec4& a, const glm::dvec4& b);

// The bodies.

namespace detail {

/// Numbers of the four coefficients that one step of de Casteljau's algorithm combines into the first of them.
struct Corners {
  int at[4];
};

template <int Degree>
constexpr std::array<Corners, net_size(Degree - 1)> kCorners = [] {
  std::array<Corners, net_size(Degree - 1)> corners{};
  for (int i = 0, n = 0; i < Degree; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k)
        corners[n++] = {{net_number(i, j, k), net_number(i + 1, j, k), net_number(i + 1, j + 1, k), net_number(i + 1, j + 1, k + 1)}};
  return corners;
}();

/// From a net of degree Degree to one of a degree less; a degree known while compiling, so that it unrolls.
template <int Degree>
inline void de_casteljau(const glm::dvec4& b, const double* from, double* to) {
  for (int n = 0; n < net_size(Degree - 1); ++n) {
    const int* at = kCorners<Degree>[n].at;  // ascending: in place, nothing is read after it was written
    to[n] = b[0] * from[at[0]] + b[1] * from[at[1]] + b[2] * from[at[2]] + b[3] * from[at[3]];
  }
}

/// Row m of `from` is a net of degree Degree with m of its polynomial's arguments fixed at b, and First - Degree - m at a. Goes on until
/// none is left.
template <int First, int Degree, std::size_t Size>
inline void blossom(const glm::dvec4& a, const glm::dvec4& b, const std::array<std::array<double, Size>, First - Degree + 1>& from,
                    std::array<double, First + 1>& bernstein) {
  constexpr int rows = First - Degree + 1;
  std::array<std::array<double, net_size(Degree - 1)>, rows + 1> to;
  // A row between the first and the last may come from either of two.
  for (int m = 0; m <= rows; ++m) {
    const bool by_a = m == 0 || (m < rows && rows > 2);
    de_casteljau<Degree>(by_a ? a : b, from[std::size_t(by_a ? m : m - 1)].data(), to[std::size_t(m)].data());
  }
  if constexpr (Degree > 1) {
    blossom<First, Degree - 1>(a, b, to, bernstein);
  } else {
    for (int m = 0; m <= rows; ++m) bernstein[std::size_t(m)] = to[std::size_t(m)][0];
  }
}

/// In place, down to degree 1.
template <int Degree>
inline void descend(const glm::dvec4& b, double* c) {
  if constexpr (Degree > 1) {
    de_casteljau<Degree>(b, c, c);
    descend<Degree - 1>(b, c);
  }
}

}  // namespace detail

template <int Degree>
TetrahedronJet evaluate_net(const TetrahedronNet<Degree>& net, const glm::dvec4& b) {
  std::array<double, std::max(net_size(Degree - 1), net_size(1))> c;
  if constexpr (Degree > 1) {
    detail::de_casteljau<Degree>(b, net.data(), c.data());
    detail::descend<Degree - 1>(b, c.data());
  } else {
    c = net;
  }
  TetrahedronJet jet;
  jet.derivatives = double(Degree) * glm::dvec3(c[1] - c[0], c[2] - c[1], c[3] - c[2]);
  jet.value = b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3];
  return jet;
}

template <int Degree>
std::array<double, Degree + 1> restrict_net(const TetrahedronNet<Degree>& net, const glm::dvec4& a, const glm::dvec4& b) {
  std::array<double, Degree + 1> bernstein;
  detail::blossom<Degree, Degree>(a, b, std::array<TetrahedronNet<Degree>, 1>{net}, bernstein);
  return bernstein;
}

}  // namespace quincunx

// The Bernstein-Bezier net of a box spline of the BCC lattice.
#pragma once

#include <cstddef>
#include <span>

namespace quincunx {

/// One orbit of the 48 symmetries of the cube: a point i >= j >= k >= 0 of the grid and the net's numerator there.
struct NetOrbit {
  int i, j, k, numerator;
};

/// The net of a generator of degree n = Degree: one function on the grid (1/n)Z^3, invariant under the 48 symmetries of the cube. A point
/// (i,j,k)/n carries net(i,j,k) / denominator. docs/splines.md tells where it comes from.
template <int Degree, int Reach>
class BoxNet {
 public:
  static constexpr int degree = Degree;
  /// The net vanishes where a coordinate passes this many n-ths of a lattice unit.
  static constexpr int reach = Reach;
  int denominator;

  /// From the orbits on which it is not zero.
  constexpr BoxNet(int denominator_, std::span<const NetOrbit> orbits) : denominator(denominator_) {
    for (const NetOrbit& q : orbits) at_[number(q.i, q.j, q.k)] = q.numerator;
  }

  /// The numerator at (i,j,k)/n; 0 outside the support.
  constexpr int operator()(int i, int j, int k) const {
    i = i < 0 ? -i : i;
    j = j < 0 ? -j : j;
    k = k < 0 ? -k : k;
    const int largest = i > j ? (i > k ? i : k) : (j > k ? j : k);
    const int least = i < j ? (i < k ? i : k) : (j < k ? j : k);
    if (largest > Reach) return 0;
    return at_[number(largest, i + j + k - largest - least, least)];
  }

 private:
  static constexpr std::size_t number(int i, int j, int k) { return std::size_t(i * (i + 1) * (i + 2) / 6 + j * (j + 1) / 2 + k); }
  /// At every i >= j >= k >= 0 up to the reach.
  int at_[(Reach + 1) * (Reach + 2) * (Reach + 3) / 6] = {};
};

/// A BoxNet of any degree.
struct NetView {
  int degree, reach, denominator;
  int (*at)(int i, int j, int k);  ///< the numerator at (i,j,k)/degree
};

template <const auto& kNet>
inline constexpr NetView kNetView = {kNet.degree, kNet.reach, kNet.denominator, [](int i, int j, int k) { return kNet(i, j, k); }};

}  // namespace quincunx

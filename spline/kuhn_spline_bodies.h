// The bodies of KuhnSpline, for the .cpp of each spline, which instantiates it.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>

#include "spline/box_net.h"
#include "spline/kuhn_spline.h"
#include "spline/quasi_interpolation.h"

namespace quincunx {
namespace detail {

/// Grid points of the reference tetrahedron 1 >= w1 >= w2 >= w3 >= 0, in the order of a TetrahedronNet.
template <int Degree>
constexpr std::array<glm::ivec3, net_size(Degree)> kGridPoints = [] {
  std::array<glm::ivec3, net_size(Degree)> points{};
  for (int i = 0; i <= Degree; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k) points[net_number(i, j, k)] = {i, j, k};
  return points;
}();

/// Sums of weights over samples are made in blocks of so many of a net's coefficients, which stay in registers.
constexpr int kWeightBlock = 12;

constexpr int weight_columns(int degree) { return (net_size(degree) + kWeightBlock - 1) / kWeightBlock * kWeightBlock; }

/// A sample that reaches the reference tetrahedron: coset (0: that of v0) and index steps along the frame's
/// axes from v0 (coset 0) or v3 (coset 1).
template <int Degree>
struct Tap {
  int coset;
  glm::ivec3 step;
  /// The net's numerators at the grid points, and columns of zeros.
  std::array<double, weight_columns(Degree)> weights;
};

template <int Degree, class Shape>
constexpr std::array<Tap<Degree>, Shape::samples> kStencil = [] {
  constexpr int reach = Shape::apron + 1;
  std::array<Tap<Degree>, Shape::samples> stencil{};
  int size = 0;
  for (int coset = 0; coset < 2; ++coset)
    for (int a = -reach; a <= reach; ++a)
      for (int b = -reach; b <= reach; ++b)
        for (int c = -reach; c <= reach; ++c) {
          Tap<Degree> tap{coset, {a, b, c}, {}};
          bool reaches = false;
          for (int n = 0; n < net_size(Degree); ++n) {
            const glm::ivec3& p = kGridPoints<Degree>[n];
            const int weight = Shape::net(p.x - Degree * (2 * a + coset), p.y - Degree * (2 * b + coset), p.z - Degree * (2 * c + coset));
            tap.weights[n] = weight;
            reaches = reaches || weight != 0;
          }
          if (reaches) stencil.at(size++) = tap;
        }
  if (size != Shape::samples) throw std::logic_error("the stencil has another number of samples");  // stops the compiler
  return stencil;
}();

/// The coset index of an even (coset 0) or odd (coset 1) lattice point.
inline glm::i64vec3 index_of(const glm::ivec3& point, int coset) {
  return (glm::i64vec3(point) - std::int64_t(coset)) / std::int64_t(2);
}

}  // namespace detail

template <int Degree, class Shape>
Jet KuhnSpline<Degree, Shape>::generator(const glm::dvec3& x) const {
  // The support goes a lattice unit farther than the net.
  if (glm::any(glm::greaterThan(glm::abs(x), glm::dvec3(Shape::net.reach / Degree + 1)))) return {};
  const glm::ivec3 cell(glm::floor(x));
  const Tetrahedron tetrahedron = locate(cell, x);
  TetrahedronNet<Degree> net;
  for (int n = 0; n < net_size(Degree); ++n) {
    glm::ivec3 q = Degree * tetrahedron.even;
    for (int a = 0; a < 3; ++a) q[tetrahedron.axis[a]] += tetrahedron.sign[tetrahedron.axis[a]] * detail::kGridPoints<Degree>[n][a];
    net[n] = Shape::net(q.x, q.y, q.z);
  }
  const TetrahedronJet jet = evaluate_net<Degree>(net, tetrahedron.barycentric(x));
  return {jet.value / Shape::net.denominator, tetrahedron.gradient_from_frame(jet.derivatives) / double(Shape::net.denominator)};
}

template <int Degree, class Shape>
TetrahedronNet<Degree> KuhnSpline<Degree, Shape>::bernstein(const Coefficients<double>& c, const Tetrahedron& tetrahedron) {
  assert(c.lattice == LatticeKind::bcc && c.apron >= Shape::apron);
  const double* bases[2] = {c.data.data() + c.number(0, detail::index_of(tetrahedron.even, 0)),
                            c.data.data() + c.number(1, detail::index_of(tetrahedron.even + tetrahedron.sign, 1))};
  const std::int64_t strides[3] = {1, c.stride_y(), c.stride_z()};
  std::int64_t h[3];
  for (int a = 0; a < 3; ++a) h[a] = tetrahedron.sign[tetrahedron.axis[a]] * strides[tetrahedron.axis[a]];

  constexpr const auto& stencil = detail::kStencil<Degree, Shape>;
  double samples[Shape::samples];
  for (int s = 0; s < Shape::samples; ++s) {
    const auto& tap = stencil[s];
    samples[s] = bases[tap.coset][tap.step.x * h[0] + tap.step.y * h[1] + tap.step.z * h[2]];
  }
  constexpr int columns = detail::weight_columns(Degree), block = detail::kWeightBlock;
  double sums[columns];
  for (int first = 0; first < columns; first += block) {
    double part[block] = {};
    for (int s = 0; s < Shape::samples; ++s)
      for (int n = 0; n < block; ++n) part[n] += stencil[s].weights[first + n] * samples[s];
    std::copy_n(part, block, sums + first);
  }
  TetrahedronNet<Degree> net;
  for (int n = 0; n < net_size(Degree); ++n) net[n] = sums[n] * (1.0 / Shape::net.denominator);
  return net;
}

template <int Degree, class Shape>
Jet KuhnSpline<Degree, Shape>::evaluate(const Coefficients<double>& c, const glm::dvec3& u) const {
  const glm::i64vec3 last = domain_max(LatticeKind::bcc, c.extents);
  assert(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, glm::dvec3(last))));
  const Tetrahedron tetrahedron = locate(cell_of(u, last), u);
  const TetrahedronJet jet = evaluate_net<Degree>(bernstein(c, tetrahedron), tetrahedron.barycentric(u));
  return {jet.value, tetrahedron.gradient_from_frame(jet.derivatives)};
}

template <int Degree, class Shape>
void KuhnSpline<Degree, Shape>::split(const glm::ivec3& cell, const glm::dvec3& o, const glm::dvec3& d, double t0, double t1,
                                      std::vector<double>& t) const {
  // Inside a cell the knot planes are those where two of the frame's coordinates w = sign (o + t d - even) are equal.
  const glm::ivec3 odd = cell & 1;
  const glm::dvec3 sign(1 - 2 * odd);
  const glm::dvec3 w = sign * (o - glm::dvec3(cell + odd)), dw = sign * d;
  const auto first = t.size();
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const double crossing = (w[b] - w[a]) / (dw[a] - dw[b]);  // not finite where the ray keeps to one side
    if (crossing > t0 && crossing < t1) t.push_back(crossing);
  }
  std::sort(t.begin() + first, t.end());
  t.erase(std::unique(t.begin() + first, t.end()), t.end());
}

template <int Degree, class Shape>
void KuhnSpline<Degree, Shape>::restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                                                    const glm::dvec3& b, std::span<double> bernstein_out) const {
  assert(bernstein_out.size() == Degree + 1);
  const Tetrahedron tetrahedron = locate(cell, 0.5 * (a + b));
  const auto along = restrict_net<Degree>(bernstein(c, tetrahedron), tetrahedron.barycentric(a), tetrahedron.barycentric(b));
  std::copy(along.begin(), along.end(), bernstein_out.begin());
}

template <int Degree, class Shape>
Coefficients<double> KuhnSpline<Degree, Shape>::coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress) const {
  const BccMask& mask = filter(prefilter).kind == Prefilter::none ? kIdentityMask : Shape::mask;
  return bcc_coefficients<double>(volume, mask, apron(), name(), {}, progress);
}

template <int Degree, class Shape>
Coefficients<float> KuhnSpline<Degree, Shape>::coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit,
                                                                  const Progress& progress) const {
  const BccMask& mask = filter(prefilter).kind == Prefilter::none ? kIdentityMask : Shape::mask;
  return bcc_coefficients<float>(volume, mask, apron(), name(), unit, progress);
}

}  // namespace quincunx

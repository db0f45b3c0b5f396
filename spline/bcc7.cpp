#include "spline/bcc7.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "spline/bcc7_net.h"
#include "spline/quasi_interpolation.h"

namespace quincunx {
namespace {

/// Quarter-grid points of the reference tetrahedron 1 >= w1 >= w2 >= w3 >= 0, in the order of a QuarticNet.
constexpr std::array<glm::ivec3, 35> kPoints = [] {
  std::array<glm::ivec3, 35> points{};
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k) points[quartic_number(i, j, k)] = {i, j, k};
  return points;
}();

constexpr int kStencilSize = 30;
constexpr int kColumns = 36;

/// A sample that reaches the reference tetrahedron: coset (0: that of v0) and index steps along the frame's
/// axes from v0 (coset 0) or v3 (coset 1).
struct Tap {
  int coset;
  glm::ivec3 step;
  /// The net's numerators at the 35 points, and one column of zeros.
  std::array<double, kColumns> weights;
};

constexpr std::array<Tap, kStencilSize> kStencil = [] {
  std::array<Tap, kStencilSize> stencil{};
  int size = 0;
  for (int coset = 0; coset < 2; ++coset)
    for (int a = -2; a <= 2; ++a)
      for (int b = -2; b <= 2; ++b)
        for (int c = -2; c <= 2; ++c) {
          Tap tap{coset, {a, b, c}, {}};
          bool reaches = false;
          for (int n = 0; n < 35; ++n) {
            const auto offset = [&](int axis) { return kPoints[n][axis] - 4 * (2 * tap.step[axis] + coset); };
            const int weight = bcc7_net(offset(0), offset(1), offset(2));
            tap.weights[n] = weight;
            reaches = reaches || weight != 0;
          }
          if (reaches) stencil.at(size++) = tap;
        }
  if (size != kStencilSize) throw std::logic_error("the stencil of bcc7 has 30 samples");  // stops the compiler
  return stencil;
}();

/// The coset index of an even (coset 0) or odd (coset 1) lattice point.
glm::i64vec3 index_of(const glm::ivec3& point, int coset) {
  return (glm::i64vec3(point) - std::int64_t(coset)) / std::int64_t(2);
}

const BccMask& mask_of(const Spline::Filter& filter) { return filter.kind == Spline::Prefilter::none ? kIdentityMask : kBcc7Mask; }

}  // namespace

Jet Bcc7::generator(const glm::dvec3& x) const {
  if (glm::any(glm::greaterThan(glm::abs(x), glm::dvec3(3.0)))) return {};
  const glm::ivec3 cell(glm::floor(x));
  const Tetrahedron tetrahedron = locate(cell, x);
  QuarticNet net;
  for (int n = 0; n < 35; ++n) {
    glm::ivec3 q = 4 * tetrahedron.even;
    for (int a = 0; a < 3; ++a) q[tetrahedron.axis[a]] += tetrahedron.sign[tetrahedron.axis[a]] * kPoints[n][a];
    net[n] = bcc7_net(q.x, q.y, q.z);
  }
  const QuarticJet jet = evaluate_quartic(net, tetrahedron.barycentric(x));
  return {jet.value / kBcc7NetDenominator,
          tetrahedron.gradient_from_frame(jet.derivatives) / double(kBcc7NetDenominator)};
}

QuarticNet Bcc7::bernstein(const Coefficients<double>& c, const Tetrahedron& tetrahedron) {
  assert(c.lattice == LatticeKind::bcc && c.apron >= 1);
  const double* bases[2] = {c.data.data() + c.number(0, index_of(tetrahedron.even, 0)),
                            c.data.data() + c.number(1, index_of(tetrahedron.even + tetrahedron.sign, 1))};
  const std::int64_t strides[3] = {1, c.stride_y(), c.stride_z()};
  std::int64_t h[3];
  for (int a = 0; a < 3; ++a) h[a] = tetrahedron.sign[tetrahedron.axis[a]] * strides[tetrahedron.axis[a]];

  double samples[kStencilSize];
  for (int s = 0; s < kStencilSize; ++s) {
    const Tap& tap = kStencil[s];
    samples[s] = bases[tap.coset][tap.step.x * h[0] + tap.step.y * h[1] + tap.step.z * h[2]];
  }
  // In blocks of columns, so that the sums stay in registers.
  constexpr int block = 12;
  double sums[kColumns];
  for (int first = 0; first < kColumns; first += block) {
    double part[block] = {};
    for (int s = 0; s < kStencilSize; ++s)
      for (int n = 0; n < block; ++n) part[n] += kStencil[s].weights[first + n] * samples[s];
    std::copy_n(part, block, sums + first);
  }
  QuarticNet net;
  for (int n = 0; n < 35; ++n) net[n] = sums[n] * (1.0 / kBcc7NetDenominator);
  return net;
}

Jet Bcc7::evaluate(const Coefficients<double>& c, const glm::dvec3& u) const {
  const glm::i64vec3 last = domain_max(LatticeKind::bcc, c.extents);
  assert(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, glm::dvec3(last))));
  const Tetrahedron tetrahedron = locate(cell_of(u, last), u);
  const QuarticJet jet = evaluate_quartic(bernstein(c, tetrahedron), tetrahedron.barycentric(u));
  return {jet.value, tetrahedron.gradient_from_frame(jet.derivatives)};
}

void Bcc7::split(const glm::ivec3& cell, const glm::dvec3& o, const glm::dvec3& d, double t0, double t1,
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

void Bcc7::restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                               const glm::dvec3& b, std::span<double> bernstein_out) const {
  assert(bernstein_out.size() == 5);
  const Tetrahedron tetrahedron = locate(cell, 0.5 * (a + b));
  const auto quartic =
      restrict_quartic(bernstein(c, tetrahedron), tetrahedron.barycentric(a), tetrahedron.barycentric(b));
  std::copy(quartic.begin(), quartic.end(), bernstein_out.begin());
}

Coefficients<double> Bcc7::coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress) const {
  return bcc_coefficients<double>(volume, mask_of(filter(prefilter)), apron(), name(), {}, progress);
}

Coefficients<float> Bcc7::coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit, const Progress& progress) const {
  return bcc_coefficients<float>(volume, mask_of(filter(prefilter)), apron(), name(), unit, progress);
}

}  // namespace quincunx

#include "spline/bcc7_derivation.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "spline/exact_box_spline.h"
#include "spline/tetrahedron.h"

namespace quincunx {
namespace {

constexpr int kDenominator = 384;
constexpr int kPoints = 35;

/// Multi-indices of the quartic Bernstein polynomials on a tetrahedron.
const std::vector<std::array<int, 4>>& multi_indices() {
  static const std::vector<std::array<int, 4>> indices = [] {
    std::vector<std::array<int, 4>> list;
    for (int a = 0; a <= 4; ++a)
      for (int b = 0; a + b <= 4; ++b)
        for (int c = 0; a + b + c <= 4; ++c) list.push_back({a, b, c, 4 - a - b - c});
    return list;
  }();
  return indices;
}

int factorial(int n) { return n <= 1 ? 1 : n * factorial(n - 1); }

int binomial(int n, int k) { return factorial(n) / (factorial(k) * factorial(n - k)); }

/// The Bernstein polynomial of `alpha` at barycentric coordinates `b`.
mpq_class bernstein(const std::array<int, 4>& alpha, const std::array<mpq_class, 4>& b) {
  mpq_class value = 24;
  for (int i = 0; i < 4; ++i) {
    for (int n = 0; n < alpha[i]; ++n) value *= b[i];
    value /= factorial(alpha[i]);
  }
  return value;
}

/// Interpolation nodes inside the tetrahedron, one for each multi-index: (alpha + 1/2) / 6.
std::array<mpq_class, 4> node(const std::array<int, 4>& alpha) {
  std::array<mpq_class, 4> b;
  for (int i = 0; i < 4; ++i) {
    b[i] = mpq_class(2 * alpha[i] + 1, 12);
    b[i].canonicalize();
  }
  return b;
}

using Matrix = std::vector<std::vector<mpq_class>>;

/// The inverse, by Gauss and Jordan.
Matrix inverse(Matrix m) {
  const std::size_t n = m.size();
  for (std::size_t r = 0; r < n; ++r) {
    m[r].resize(2 * n);
    m[r][n + r] = 1;
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    while (m[pivot][c] == 0) ++pivot;
    std::swap(m[pivot], m[c]);
    const mpq_class divisor = m[c][c];
    for (mpq_class& x : m[c]) x /= divisor;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c || m[r][c] == 0) continue;
      const mpq_class factor = m[r][c];
      for (std::size_t k = c; k < 2 * n; ++k) m[r][k] -= factor * m[c][k];
    }
  }
  for (auto& row : m) row.erase(row.begin(), row.begin() + std::ptrdiff_t(n));
  return m;
}

/// From values at the nodes to Bernstein coefficients.
Matrix interpolation() {
  Matrix values;
  for (const auto& at : multi_indices()) {
    std::vector<mpq_class> row;
    for (const auto& alpha : multi_indices()) row.push_back(bernstein(alpha, node(at)));
    values.push_back(std::move(row));
  }
  return inverse(std::move(values));
}

/// The tetrahedra of the sector x >= y >= z >= 0 within the support of M7, |x| < 3.
std::vector<Tetrahedron> sector_tetrahedra() {
  std::vector<Tetrahedron> list;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y <= x; ++y)
      for (int z = 0; z <= y; ++z) {
        const glm::ivec3 cell(x, y, z), odd = cell & 1;
        glm::ivec3 axis(0, 1, 2);
        do {
          const Tetrahedron t{cell + odd, 1 - 2 * odd, axis};
          const auto inside = [&](int i) { return t.vertex(i).x >= t.vertex(i).y && t.vertex(i).y >= t.vertex(i).z; };
          if (inside(0) && inside(1) && inside(2) && inside(3)) list.push_back(t);
        } while (std::next_permutation(&axis.x, &axis.x + 3));
      }
  return list;
}

RationalPoint point(const Tetrahedron& t, const std::array<mpq_class, 4>& b) {
  RationalPoint x;
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) x[a] += b[i] * t.vertex(i)[a];
  return x;
}

QuarterPoint sector_point(const glm::ivec3& q) {
  QuarterPoint sorted = {std::abs(q.x), std::abs(q.y), std::abs(q.z)};
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  return sorted;
}

/// Enters the coefficients of one tetrahedron.
void enter(const Tetrahedron& t, const std::vector<mpq_class>& coefficients, std::map<QuarterPoint, int>& net) {
  for (int n = 0; n < kPoints; ++n) {
    glm::ivec3 q(0);
    for (int i = 0; i < 4; ++i) q += multi_indices()[n][i] * t.vertex(i);
    const mpq_class numerator = coefficients[n] * kDenominator;
    if (numerator.get_den() != 1) throw std::logic_error("a coefficient of the net is no integer over 384");
    const int value = int(numerator.get_num().get_si());
    const auto [entry, is_new] = net.emplace(sector_point(q), value);
    if (!is_new && entry->second != value) throw std::logic_error("tetrahedra disagree on a coefficient of the net");
  }
}

}  // namespace

std::map<QuarterPoint, int> derive_bcc7_net() {
  ExactBoxSpline spline(bcc7_directions());
  const Matrix from_values = interpolation();
  std::map<QuarterPoint, int> net;
  for (const Tetrahedron& t : sector_tetrahedra()) {
    std::vector<mpq_class> values, coefficients(kPoints);
    for (const auto& alpha : multi_indices()) values.push_back(4 * spline.value(point(t, node(alpha))));
    for (int n = 0; n < kPoints; ++n)
      for (int m = 0; m < kPoints; ++m) coefficients[n] += from_values[n][m] * values[m];
    enter(t, coefficients, net);
  }
  std::erase_if(net, [](const auto& entry) { return entry.second == 0; });
  return net;
}

int net_at(const std::map<QuarterPoint, int>& net, const glm::ivec3& q) {
  const auto found = net.find(sector_point(q));
  return found == net.end() ? 0 : found->second;
}

std::vector<glm::ivec3> bcc7_stencil(const std::map<QuarterPoint, int>& net) {
  std::vector<glm::ivec3> stencil;
  for (int x = -4; x <= 5; ++x)
    for (int y = -4; y <= 5; ++y)
      for (int z = -4; z <= 5; ++z) {
        if ((x - y) % 2 != 0 || (y - z) % 2 != 0) continue;
        bool reaches = false;
        for (int i = 0; i <= 4; ++i)
          for (int j = 0; j <= i; ++j)
            for (int k = 0; k <= j; ++k) reaches = reaches || net_at(net, {i - 4 * x, j - 4 * y, k - 4 * z}) != 0;
        if (reaches) stencil.emplace_back(x, y, z);
      }
  return stencil;
}

std::map<QuarterPoint, LinearForm> bcc7_monomials(const std::map<QuarterPoint, int>& net,
                                                  const std::vector<glm::ivec3>& stencil) {
  // With E_i the shift towards v_i, the coefficient of x^a y^b z^c is, at v0 and with d = 4 - a - b - c,
  // 4! / (a! b! c! d!) (E_1 - E_0)^a (E_2 - E_1)^b (E_3 - E_2)^c E_0^d.
  std::map<QuarterPoint, LinearForm> monomials;
  for (const auto& [a, b, c, d] : multi_indices()) {
    LinearForm form;
    for (int i = 0; i <= a; ++i)
      for (int j = 0; j <= b; ++j)
        for (int k = 0; k <= c; ++k) {
          const int parity = (a - i + b - j + c - k) % 2 == 0 ? 1 : -1;
          const int factor = parity * binomial(a, i) * binomial(b, j) * binomial(c, k) * 24 /
                             (factorial(a) * factorial(b) * factorial(c) * factorial(d));
          const int e1 = i + b - j, e2 = j + c - k, e3 = k;  // powers of the shifts
          const glm::ivec3 q(e1 + e2 + e3, e2 + e3, e3);
          for (int s = 0; s < int(stencil.size()); ++s) form[s] += factor * net_at(net, q - 4 * stencil[s]);
        }
    std::erase_if(form, [](const auto& term) { return term.second == 0; });
    if (!form.empty()) monomials.emplace(QuarterPoint{a, b, c}, std::move(form));
  }
  return monomials;
}

}  // namespace quincunx

#include "spline/box_net_derivation.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

#include "spline/exact_box_spline.h"
#include "spline/tetrahedron.h"

namespace quincunx {
namespace {

/// Multi-indices of the Bernstein polynomials of degree n on a tetrahedron.
std::vector<std::array<int, 4>> multi_indices(int n) {
  std::vector<std::array<int, 4>> list;
  for (int a = 0; a <= n; ++a)
    for (int b = 0; a + b <= n; ++b)
      for (int c = 0; a + b + c <= n; ++c) list.push_back({a, b, c, n - a - b - c});
  return list;
}

int factorial(int n) { return n <= 1 ? 1 : n * factorial(n - 1); }

int binomial(int n, int k) { return factorial(n) / (factorial(k) * factorial(n - k)); }

/// The Bernstein polynomial of `alpha` at barycentric coordinates `b`.
mpq_class bernstein(const std::array<int, 4>& alpha, const std::array<mpq_class, 4>& b) {
  mpq_class value = factorial(std::accumulate(alpha.begin(), alpha.end(), 0));
  for (int i = 0; i < 4; ++i) {
    for (int n = 0; n < alpha[i]; ++n) value *= b[i];
    value /= factorial(alpha[i]);
  }
  return value;
}

/// Interpolation nodes inside the tetrahedron, one for each multi-index: (alpha + 1/2) / (n + 2).
std::array<mpq_class, 4> node(const std::array<int, 4>& alpha) {
  const int n = std::accumulate(alpha.begin(), alpha.end(), 0);
  std::array<mpq_class, 4> b;
  for (int i = 0; i < 4; ++i) {
    b[i] = mpq_class(2 * alpha[i] + 1, 2 * n + 4);
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
Matrix interpolation(const std::vector<std::array<int, 4>>& indices) {
  Matrix values;
  for (const auto& at : indices) {
    std::vector<mpq_class> row;
    for (const auto& alpha : indices) row.push_back(bernstein(alpha, node(at)));
    values.push_back(std::move(row));
  }
  return inverse(std::move(values));
}

/// The tetrahedra of the sector x >= y >= z >= 0 with x < reach.
std::vector<Tetrahedron> sector_tetrahedra(int reach) {
  std::vector<Tetrahedron> list;
  for (int x = 0; x < reach; ++x)
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

GridPoint sector_point(const glm::ivec3& q) {
  GridPoint sorted = {std::abs(q.x), std::abs(q.y), std::abs(q.z)};
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  return sorted;
}

/// The Bernstein coefficients that are not zero, by grid point.
std::map<GridPoint, mpq_class> rational_net(const DerivedSpline& spline) {
  const std::vector<std::array<int, 4>> indices = multi_indices(spline.degree());
  const Matrix from_values = interpolation(indices);
  ExactBoxSpline box(spline.directions);
  std::map<GridPoint, mpq_class> net;
  for (const Tetrahedron& t : sector_tetrahedra(spline.reach())) {
    std::vector<mpq_class> values;
    for (const auto& alpha : indices) values.push_back(4 * box.value(point(t, node(alpha))));
    for (std::size_t n = 0; n < indices.size(); ++n) {
      mpq_class coefficient;
      for (std::size_t m = 0; m < indices.size(); ++m) coefficient += from_values[n][m] * values[m];
      glm::ivec3 q(0);
      for (int i = 0; i < 4; ++i) q += indices[n][i] * t.vertex(i);
      const auto [entry, is_new] = net.emplace(sector_point(q), coefficient);
      if (!is_new && entry->second != coefficient) throw std::logic_error("tetrahedra disagree on a coefficient of the net of " + spline.name);
    }
  }
  std::erase_if(net, [](const auto& entry) { return entry.second == 0; });
  return net;
}

}  // namespace

int DerivedSpline::reach() const {
  int sum = 0;
  for (const glm::ivec3& direction : directions) sum += std::abs(direction.x);
  return sum / 2;
}

const std::vector<DerivedSpline>& derived_splines() {
  static const std::vector<DerivedSpline> list = {
      {"bcc4", bcc4_directions(), 2},
      {"bcc7", bcc7_directions(), 96},
      {"bcc8", bcc8_directions(), 192},
  };
  return list;
}

int ExactNet::at(const glm::ivec3& q) const {
  const auto found = numerators.find(sector_point(q));
  return found == numerators.end() ? 0 : found->second;
}

ExactNet derive_net(const DerivedSpline& spline) {
  const std::map<GridPoint, mpq_class> rationals = rational_net(spline);
  mpz_class denominator = 1;
  for (const auto& [q, coefficient] : rationals) denominator = lcm(denominator, coefficient.get_den());
  ExactNet net{spline.degree(), int(denominator.get_si()), {}};
  for (const auto& [q, coefficient] : rationals) net.numerators.emplace(q, int(mpz_class(coefficient * denominator).get_si()));
  return net;
}

std::vector<glm::ivec3> stencil_of(const ExactNet& net) {
  const int n = net.degree;
  std::vector<glm::ivec3> stencil;
  for (int x = -4; x <= 5; ++x)
    for (int y = -4; y <= 5; ++y)
      for (int z = -4; z <= 5; ++z) {
        if ((x - y) % 2 != 0 || (y - z) % 2 != 0) continue;
        bool reaches = false;
        for (int i = 0; i <= n; ++i)
          for (int j = 0; j <= i; ++j)
            for (int k = 0; k <= j; ++k) reaches = reaches || net.at({i - n * x, j - n * y, k - n * z}) != 0;
        if (reaches) stencil.emplace_back(x, y, z);
      }
  return stencil;
}

std::map<GridPoint, LinearForm> monomials_of(const ExactNet& net, const std::vector<glm::ivec3>& stencil) {
  // With E_i the shift towards v_i, the coefficient of x^a y^b z^c is, at v0 and with d = n - a - b - c,
  // n! / (a! b! c! d!) (E_1 - E_0)^a (E_2 - E_1)^b (E_3 - E_2)^c E_0^d.
  const int n = net.degree;
  std::map<GridPoint, LinearForm> monomials;
  for (const auto& [a, b, c, d] : multi_indices(n)) {
    LinearForm form;
    for (int i = 0; i <= a; ++i)
      for (int j = 0; j <= b; ++j)
        for (int k = 0; k <= c; ++k) {
          const int parity = (a - i + b - j + c - k) % 2 == 0 ? 1 : -1;
          const int factor = parity * binomial(a, i) * binomial(b, j) * binomial(c, k) * factorial(n) /
                             (factorial(a) * factorial(b) * factorial(c) * factorial(d));
          const int e1 = i + b - j, e2 = j + c - k, e3 = k;  // powers of the shifts
          const glm::ivec3 q(e1 + e2 + e3, e2 + e3, e3);
          for (int s = 0; s < int(stencil.size()); ++s) form[s] += factor * net.at(q - n * stencil[s]);
        }
    std::erase_if(form, [](const auto& term) { return term.second == 0; });
    if (!form.empty()) monomials.emplace(GridPoint{a, b, c}, std::move(form));
  }
  return monomials;
}

}  // namespace quincunx

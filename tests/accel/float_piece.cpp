#include "float_piece.h"

#include <algorithm>

namespace quincunx {
namespace {

constexpr int binomial(int n, int k) { return k == 0 ? 1 : binomial(n, k - 1) * (n - k + 1) / k; }

/// The weight that the sample at `at` (frame coordinates from the even corner) has in `denominator` times the coefficient of
/// w1^a w2^b w3^c: the polar form at the differences of consecutive vertices, a binomial sum over the net.
int monomial_weight(const NetView& net, int a, int b, int c, const glm::ivec3& at) {
  const int n = net.degree;
  int sum = 0;
  for (int i = 0; i <= a; ++i)
    for (int j = 0; j <= b; ++j)
      for (int k = 0; k <= c; ++k) {
        const glm::ivec3 q = glm::ivec3(b + c + i, c + j, k) - n * at;
        const int sign = (a - i + b - j + c - k) % 2 == 0 ? 1 : -1;
        sum += sign * binomial(a, i) * binomial(b, j) * binomial(c, k) * net.at(q.x, q.y, q.z);
      }
  return sum * binomial(n, a) * binomial(n - a, b) * binomial(n - a - b, c);
}

/// (p + t d) * a + b, polynomials in t.
std::vector<float> multiply_add(const std::vector<float>& a, float p, float d, const std::vector<float>& b) {
  std::vector<float> r = b;
  r.resize(std::max(a.size() + 1, b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) r[i] += p * a[i];
  for (std::size_t i = 0; i < a.size(); ++i) r[i + 1] += d * a[i];
  return r;
}

}  // namespace

std::vector<StencilSample> piece_stencil(const NetView& net) {
  const int n = net.degree;
  std::vector<StencilSample> stencil;
  for (int x = -4; x <= 5; ++x)
    for (int y = -4; y <= 5; ++y)
      for (int z = -4; z <= 5; ++z) {
        if ((x - y) % 2 != 0 || (y - z) % 2 != 0) continue;
        StencilSample s{{x, y, z}, {}};
        bool reaches = false;
        for (int a = 0; a <= n; ++a)
          for (int b = 0; a + b <= n; ++b)
            for (int c = 0; a + b + c <= n; ++c) {
              const int w = monomial_weight(net, a, b, c, s.at);
              s.weight.push_back(float(w));
              reaches |= w != 0;
            }
        if (reaches) stencil.push_back(s);
      }
  return stencil;
}

FloatPiece::FloatPiece(const Coefficients<float>& c, const Tetrahedron& tetrahedron, const NetView& net, const std::vector<StencilSample>& stencil)
    : net_(net), monomials_(stencil.front().weight.size()) {
  for (const StencilSample& s : stencil) {
    glm::ivec3 u = tetrahedron.even;
    for (int a = 0; a < 3; ++a) u[tetrahedron.axis[a]] += tetrahedron.sign[tetrahedron.axis[a]] * s.at[a];
    const int coset = u.x & 1;
    const float sample = c.data[c.number(coset, glm::i64vec3((u - coset) / 2))];
    for (std::size_t n = 0; n < monomials_.size(); ++n) monomials_[n] += s.weight[n] * sample;
  }
}

float FloatPiece::value(const glm::vec3& w) const {
  float f = 0.0f;
  std::size_t end = monomials_.size();
  // Monomials ascend by i, then j, then k: walk them backwards.
  for (int i = net_.degree; i >= 0; --i) {
    float g = 0.0f;
    for (int j = net_.degree - i; j >= 0; --j) {
      float h = 0.0f;
      for (int k = net_.degree - i - j; k >= 0; --k) h = h * w.z + monomials_[--end];
      g = g * w.y + h;
    }
    f = f * w.x + g;
  }
  return f * (1.0f / float(net_.denominator));
}

std::vector<float> FloatPiece::bernstein(const glm::vec3& a, const glm::vec3& b) const {
  const glm::vec3 d = b - a;
  const int n = net_.degree;
  std::vector<float> f;
  std::size_t end = monomials_.size();
  for (int i = n; i >= 0; --i) {
    std::vector<float> g;
    for (int j = n - i; j >= 0; --j) {
      std::vector<float> h;
      for (int k = n - i - j; k >= 0; --k) h = multiply_add(h, a.z, d.z, {monomials_[--end]});
      g = multiply_add(g, a.y, d.y, h);
    }
    f = multiply_add(f, a.x, d.x, g);
  }
  f.resize(std::size_t(n) + 1);
  // The differences of Bernstein coefficients at t = 0 are f_k / binomial(n, k).
  for (int k = 0; k <= n; ++k) f[std::size_t(k)] *= 1.0f / float(binomial(n, k) * net_.denominator);
  for (int m = 1; m <= n; ++m)
    for (int k = n; k >= m; --k) f[std::size_t(k)] += f[std::size_t(k - 1)];
  return f;
}

}  // namespace quincunx

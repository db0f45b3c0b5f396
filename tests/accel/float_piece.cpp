#include "float_piece.h"

#include <vector>

#include "spline/bcc7_net.h"

namespace quincunx {
namespace {

constexpr int binomial(int n, int k) { return k == 0 ? 1 : binomial(n, k - 1) * (n - k + 1) / k; }

/// The weight that the sample at `at` (frame coordinates from the even corner) has in 384 times the coefficient of
/// w1^a w2^b w3^c: the polar form at the differences of consecutive vertices, a binomial sum over the net.
int monomial_weight(int a, int b, int c, const glm::ivec3& at) {
  int sum = 0;
  for (int i = 0; i <= a; ++i)
    for (int j = 0; j <= b; ++j)
      for (int k = 0; k <= c; ++k) {
        const glm::ivec3 q = glm::ivec3(b + c + i, c + j, k) - 4 * at;
        const int sign = (a - i + b - j + c - k) % 2 == 0 ? 1 : -1;
        sum += sign * binomial(a, i) * binomial(b, j) * binomial(c, k) * bcc7_net(q.x, q.y, q.z);
      }
  return sum * binomial(4, a) * binomial(4 - a, b) * binomial(4 - a - b, c);
}

struct StencilSample {
  glm::ivec3 at;
  std::array<float, 35> weight;
};

/// The samples that reach the reference tetrahedron 1 >= w1 >= w2 >= w3 >= 0.
std::vector<StencilSample> make_stencil() {
  std::vector<StencilSample> stencil;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) {
        if ((x - y) % 2 != 0 || (y - z) % 2 != 0) continue;
        StencilSample s{{x, y, z}, {}};
        bool reaches = false;
        int n = 0;
        for (int a = 0; a <= 4; ++a)
          for (int b = 0; a + b <= 4; ++b)
            for (int c = 0; a + b + c <= 4; ++c) {
              const int w = monomial_weight(a, b, c, s.at);
              s.weight[std::size_t(n++)] = float(w);
              reaches |= w != 0;
            }
        if (reaches) stencil.push_back(s);
      }
  return stencil;
}

}  // namespace

FloatPiece::FloatPiece(const Coefficients<float>& c, const Tetrahedron& tetrahedron) : monomials_{} {
  static const std::vector<StencilSample> stencil = make_stencil();
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
  for (int i = 4; i >= 0; --i) {
    float g = 0.0f;
    for (int j = 4 - i; j >= 0; --j) {
      float h = 0.0f;
      for (int k = 4 - i - j; k >= 0; --k) h = h * w.z + monomials_[--end];
      g = g * w.y + h;
    }
    f = f * w.x + g;
  }
  return f * (1.0f / 384.0f);
}

std::array<float, 5> FloatPiece::bernstein(const glm::vec3& a, const glm::vec3& b) const {
  const glm::vec3 d = b - a;
  const float f0 = value(a), f1 = value(a + 0.25f * d), f2 = value(a + 0.5f * d), f3 = value(a + 0.75f * d),
              f4 = value(b);
  return {f0, (-13.0f * f0 + 48.0f * f1 - 36.0f * f2 + 16.0f * f3 - 3.0f * f4) * (1.0f / 12.0f),
          (13.0f * (f0 + f4) - 64.0f * (f1 + f3) + 120.0f * f2) * (1.0f / 18.0f),
          (-13.0f * f4 + 48.0f * f3 - 36.0f * f2 + 16.0f * f1 - 3.0f * f0) * (1.0f / 12.0f), f4};
}

}  // namespace quincunx

#include "float_kernel.h"

#include <array>
#include <stdexcept>
#include <string>

#include "float_piece.h"
#include "spline/bcc4_net.h"
#include "spline/bcc7_net.h"
#include "spline/bcc8_net.h"

namespace quincunx {
namespace {

/// A box spline of the BCC lattice: a tetrahedron.
template <const auto& kNet>
class Kuhn final : public FloatKernel {
 public:
  Kuhn(const Coefficients<float>& c, const Tetrahedron& tetrahedron) : tetrahedron_(tetrahedron), piece_(c, tetrahedron, kNetView<kNet>, stencil()) {}

  float value(const glm::dvec3& u) const override { return piece_.value(glm::vec3(tetrahedron_.frame(u))); }
  std::vector<float> bernstein(const glm::dvec3& a, const glm::dvec3& b) const override {
    return piece_.bernstein(glm::vec3(tetrahedron_.frame(a)), glm::vec3(tetrahedron_.frame(b)));
  }
  glm::dvec3 vertex(int n) const override { return glm::dvec3(tetrahedron_.vertex(n % 4)); }

 private:
  static const std::vector<StencilSample>& stencil() {
    static const std::vector<StencilSample> samples = piece_stencil(kNetView<kNet>);
    return samples;
  }
  Tetrahedron tetrahedron_;
  FloatPiece piece_;
};

/// A cell, seen as a part of the cube between 8 samples of a Cartesian lattice or of a coset.
class Cube : public FloatKernel {
 public:
  Cube(const Coefficients<float>& c, const glm::ivec3& cell, int coset = 0)
      : c_(c), cell_(cell), coset_(coset), index_(c.lattice == LatticeKind::bcc ? (cell - coset) >> 1 : cell) {}
  glm::dvec3 vertex(int n) const override { return glm::dvec3(cell_ + glm::ivec3(n & 1, n >> 1 & 1, n >> 2 & 1)); }

 protected:
  float sample(int i, int j, int k) const { return c_.data[c_.number(coset_, glm::i64vec3(index_ + glm::ivec3(i, j, k)))]; }
  glm::vec3 own(const glm::dvec3& u) const {
    const glm::vec3 w(u - glm::dvec3(cell_));
    const int step = lattice_step(c_.lattice);
    return glm::vec3(cell_ - step * index_ - coset_) / float(step) + w / float(step);
  }

 private:
  const Coefficients<float>& c_;
  glm::ivec3 cell_;
  int coset_;
  glm::ivec3 index_;
};

class Linear final : public Cube {
 public:
  using Cube::Cube;
  float value(const glm::dvec3& u) const override {
    const glm::vec3 w = own(u);
    return polynomial(w.x, w.y, w.z);
  }
  std::vector<float> bernstein(const glm::dvec3& from, const glm::dvec3& to) const override {
    const glm::vec3 a = own(from), b = own(to);
    const auto f = [this](float x, float y, float z) { return polynomial(x, y, z); };
    return {f(a.x, a.y, a.z), (f(b.x, a.y, a.z) + f(a.x, b.y, a.z) + f(a.x, a.y, b.z)) * (1.0f / 3.0f),
            (f(a.x, b.y, b.z) + f(b.x, a.y, b.z) + f(b.x, b.y, a.z)) * (1.0f / 3.0f), f(b.x, b.y, b.z)};
  }

 private:
  static float mix(float a, float b, float t) { return a + t * (b - a); }
  float polynomial(float x, float y, float z) const {
    const auto edge = [&](int j, int k) { return mix(sample(0, j, k), sample(1, j, k), x); };
    return mix(mix(edge(0, 0), edge(1, 0), y), mix(edge(0, 1), edge(1, 1), y), z);
  }
};

/// One of the eight pieces of a cell. Weights twice too large, so the values are divided by 8 at the end.
class Quadratic final : public Cube {
 public:
  Quadratic(const Coefficients<float>& c, const glm::ivec3& cell, const glm::dvec3& u)
      : Cube(c, cell), low_(cell), above_(glm::greaterThanEqual(u, low_ + 0.5)) {}
  glm::dvec3 vertex(int n) const override { return low_ + 0.5 * glm::dvec3(above_) + 0.5 * glm::dvec3(n & 1, n >> 1 & 1, n >> 2 & 1); }
  float value(const glm::dvec3& u) const override {
    const glm::vec3 t = piece(u);
    const Weights x = at(t.x), y = at(t.y), z = at(t.z);
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) sum += z[k] * (y[j] * ((x[0] * reached(0, j, k) + x[1] * reached(1, j, k)) + x[2] * reached(2, j, k)));
    return sum * (1.0f / 8.0f);
  }
  std::vector<float> bernstein(const glm::dvec3& from, const glm::dvec3& to) const override {
    const glm::vec3 p = piece(from), q = piece(to);
    const auto x = along(p.x, q.x), y = along(p.y, q.y), z = along(p.z, q.z);
    std::vector<float> sum(7);
    for (int k = 0; k < 3; ++k) {
      float plane[5] = {};
      for (int j = 0; j < 3; ++j)
        for (int m = 0; m < 3; ++m) {
          float row = 0.0f;
          for (int i = 0; i < 3; ++i) row += x[i][m] * reached(i, j, k);
          for (int n = 0; n < 3; ++n) plane[m + n] += row * y[j][n];
        }
      for (int m = 0; m < 5; ++m)
        for (int n = 0; n < 3; ++n) sum[std::size_t(m + n)] += plane[m] * z[k][n];
    }
    const float binomials[7] = {1, 6, 15, 20, 15, 6, 1};
    for (int m = 0; m < 7; ++m) sum[std::size_t(m)] *= 1.0f / 8.0f / binomials[m];
    return sum;
  }

 private:
  using Weights = std::array<float, 3>;
  glm::vec3 piece(const glm::dvec3& u) const { return own(u) + glm::mix(glm::vec3(0.5f), glm::vec3(-0.5f), above_); }
  float reached(int i, int j, int k) const { return sample(i - !above_.x, j - !above_.y, k - !above_.z); }
  static Weights at(float t) { return {(1.0f - t) * (1.0f - t), 1.0f + 2.0f * (t * (1.0f - t)), t * t}; }
  /// Polar forms of the weights at (p,p), (p,q), (q,q), times 1, 2, 1.
  static std::array<Weights, 3> along(float p, float q) {
    const float r = 1.0f - p, s = 1.0f - q;
    return {Weights{r * r, 2.0f * (r * s), s * s}, {1.0f + 2.0f * (p * r), 2.0f + 2.0f * (p * s + q * r), 1.0f + 2.0f * (q * s)},
            {p * p, 2.0f * (p * q), q * q}};
  }
  glm::dvec3 low_;
  glm::bvec3 above_;
};

using Weights = std::array<float, 4>;

struct BSpline {
  static constexpr float kScale = 6.0f;
  static Weights at(float x) {
    const float y = 1.0f - x;
    return {y * y * y, 4.0f + x * x * (3.0f * x - 6.0f), 4.0f + y * y * (3.0f * y - 6.0f), x * x * x};
  }
  /// Polar forms of the weights at (p,p,p), (p,p,q), (p,q,q), (q,q,q), times 1, 3, 3, 1.
  static Weights outer(float p, float q) { return {p * p * p, 3.0f * (p * p * q), 3.0f * (p * q * q), q * q * q}; }
  static Weights inner(float p, float q) {
    const auto polar = [](float a, float b, float c) { return 4.0f - 2.0f * (a * b + b * c + c * a) + 3.0f * (a * b * c); };
    return {polar(p, p, p), 3.0f * polar(p, p, q), 3.0f * polar(p, q, q), polar(q, q, q)};
  }
  static std::array<Weights, 4> along(float p, float q) {
    return {outer(1.0f - p, 1.0f - q), inner(p, q), inner(1.0f - p, 1.0f - q), outer(p, q)};
  }
};

/// A cell of the BCC lattice, mixed of both cosets by cosines.
class CosineWeighted final : public FloatKernel {
 public:
  CosineWeighted(const Coefficients<float>& c, const glm::ivec3& cell) : c_(c), even_(cell + (cell & 1)), sign_(1 - 2 * (cell & 1)) {}

  float value(const glm::dvec3& p) const override {
    const glm::vec3 u(glm::dvec3(sign_) * (p - glm::dvec3(even_)));
    const float even = cube(0, even_ / 2, sign_, 0.5f * u), odd = cube(1, (even_ + sign_ - 1) / 2, -sign_, 0.5f * (1.0f - u));
    const glm::vec3 c = sine(0.5f - u);
    return odd + (0.5f + (c.x + c.y + c.z) * (1.0f / 6.0f)) * (even - odd);
  }
  std::vector<float> bernstein(const glm::dvec3& a, const glm::dvec3& b) const override { return {value(a), value(0.5 * (a + b)), value(b)}; }
  glm::dvec3 vertex(int n) const override { return glm::dvec3(even_ + sign_ * glm::ivec3(n & 1, n >> 1 & 1, n >> 2 & 1)); }

 private:
  static float mix(float a, float b, float t) { return a + t * (b - a); }
  float cube(int coset, const glm::ivec3& corner, const glm::ivec3& step, const glm::vec3& v) const {
    const auto sample = [&](int i, int j, int k) { return c_.data[c_.number(coset, glm::i64vec3(corner + step * glm::ivec3(i, j, k)))]; };
    const auto edge = [&](int j, int k) { return mix(sample(0, j, k), sample(1, j, k), v.x); };
    return mix(mix(edge(0, 0), edge(1, 0), v.y), mix(edge(0, 1), edge(1, 1), v.y), v.z);
  }
  /// sin(pi y), |y| <= 1/2.
  static glm::vec3 sine(const glm::vec3& y) {
    const glm::vec3 z = y * y;
    glm::vec3 sum(0.0004663028058f);
    for (const float c : {-0.007370430946f, 0.08214588661f, -0.5992645293f, 2.55016404f, -5.16771278f, 3.141592654f}) sum = c + z * sum;
    return y * sum;
  }

  const Coefficients<float>& c_;
  glm::ivec3 even_, sign_;
};

struct CatmullRom {
  static constexpr float kScale = 2.0f;
  static Weights at(float x) {
    const float y = 1.0f - x;
    return {-(x * (y * y)), 2.0f + x * x * (3.0f * x - 5.0f), 2.0f + y * y * (3.0f * y - 5.0f), -(y * (x * x))};
  }
  static Weights outer(float p, float q) {
    const float r = 1.0f - p, s = 1.0f - q;
    return {-(p * r * r), -(2.0f * (p * r * s) + q * r * r), -(p * s * s + 2.0f * (q * r * s)), -(q * s * s)};
  }
  static Weights inner(float p, float q) {
    const auto polar = [](float a, float b, float c) { return 6.0f - 5.0f * (a * b + b * c + c * a) + 9.0f * (a * b * c); };
    return {polar(p, p, p) * (1.0f / 3.0f), polar(p, p, q), polar(p, q, q), polar(q, q, q) * (1.0f / 3.0f)};
  }
  static std::array<Weights, 4> along(float p, float q) {
    return {outer(p, q), inner(p, q), inner(1.0f - p, 1.0f - q), outer(1.0f - p, 1.0f - q)};
  }
};

/// Weights Basis::kScale times too large, so the values are divided by its cube at the end.
template <class Basis>
class Cubic final : public Cube {
 public:
  using Cube::Cube;
  float value(const glm::dvec3& u) const override {
    const glm::vec3 w = own(u);
    const Weights x = Basis::at(w.x), y = Basis::at(w.y), z = Basis::at(w.z);
    float sum = 0.0f;
    for (int k = 0; k < 4; ++k) {
      float plane = 0.0f;
      for (int j = 0; j < 4; ++j) {
        float row = 0.0f;
        for (int i = 0; i < 4; ++i) row += x[i] * sample(i - 1, j - 1, k - 1);
        plane += y[j] * row;
      }
      sum += z[k] * plane;
    }
    return sum * (1.0f / (Basis::kScale * Basis::kScale * Basis::kScale));
  }
  std::vector<float> bernstein(const glm::dvec3& from, const glm::dvec3& to) const override {
    const glm::vec3 a = own(from), b = own(to);
    const auto x = Basis::along(a.x, b.x), y = Basis::along(a.y, b.y), z = Basis::along(a.z, b.z);
    std::vector<float> sum(10);
    for (int k = 0; k < 4; ++k) {
      float plane[7] = {};
      for (int j = 0; j < 4; ++j)
        for (int m = 0; m < 4; ++m) {
          float row = 0.0f;
          for (int i = 0; i < 4; ++i) row += x[i][m] * sample(i - 1, j - 1, k - 1);
          for (int n = 0; n < 4; ++n) plane[m + n] += row * y[j][n];
        }
      for (int m = 0; m < 7; ++m)
        for (int n = 0; n < 4; ++n) sum[std::size_t(m + n)] += plane[m] * z[k][n];
    }
    const float binomials[10] = {1, 9, 36, 84, 126, 126, 84, 36, 9, 1};
    for (int m = 0; m < 10; ++m) sum[std::size_t(m)] *= 1.0f / (Basis::kScale * Basis::kScale * Basis::kScale) / binomials[m];
    return sum;
  }
};

/// bcc12: the cubes of the two cosets, halved and added.
class TwoCubes final : public FloatKernel {
 public:
  TwoCubes(const Coefficients<float>& c, const glm::ivec3& cell) : even_(c, cell, 0), odd_(c, cell, 1) {}
  float value(const glm::dvec3& u) const override { return 0.5f * (even_.value(u) + odd_.value(u)); }
  std::vector<float> bernstein(const glm::dvec3& a, const glm::dvec3& b) const override {
    std::vector<float> sum = even_.bernstein(a, b);
    const std::vector<float> odd = odd_.bernstein(a, b);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 0.5f * (sum[i] + odd[i]);
    return sum;
  }
  glm::dvec3 vertex(int n) const override { return even_.vertex(n); }

 private:
  Cubic<BSpline> even_, odd_;
};

}  // namespace

std::unique_ptr<FloatKernel> float_kernel(const Spline& spline, const Coefficients<float>& c, const glm::ivec3& cell,
                                          const glm::dvec3& u) {
  if (spline.name() == "cwlb") return std::make_unique<CosineWeighted>(c, cell);
  if (spline.name() == "bcc4") return std::make_unique<Kuhn<kBcc4Net>>(c, locate(cell, u));
  if (spline.name() == "bcc7") return std::make_unique<Kuhn<kBcc7Net>>(c, locate(cell, u));
  if (spline.name() == "bcc8") return std::make_unique<Kuhn<kBcc8Net>>(c, locate(cell, u));
  if (spline.name() == "bcc12") return std::make_unique<TwoCubes>(c, cell);
  if (spline.name() == "trilinear") return std::make_unique<Linear>(c, cell);
  if (spline.name() == "triquadratic") return std::make_unique<Quadratic>(c, cell, u);
  if (spline.name() == "tricubic") return std::make_unique<Cubic<BSpline>>(c, cell);
  if (spline.name() == "catmull-rom") return std::make_unique<Cubic<CatmullRom>>(c, cell);
  throw std::logic_error("no kernel in floats for spline " + std::string(spline.name()));
}

}  // namespace quincunx

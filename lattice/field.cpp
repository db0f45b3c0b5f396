#include "lattice/field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "lattice/error.h"

namespace quincunx {
namespace {

using glm::dvec3;
using std::numbers::pi;

/// S. Marschner, R. Lobb, An evaluation of reconstruction filters for volume rendering, 1994,
/// DOI 10.1109/VISUAL.1994.346331, section 5 (test signal):
///   rho(x,y,z) = (1 - sin(pi z / 2) + alpha (1 + rho_r(sqrt(x^2 + y^2)))) / (2 (1 + alpha))
///   rho_r(r)   = cos(2 pi f_M cos(pi r / 2))
class MarschnerLobb final : public Field {
 public:
  std::string_view name() const override { return "marschner-lobb"; }
  double value(const dvec3& x) const override {
    const double rho_r = std::cos(2.0 * pi * f_M * std::cos(0.5 * pi * std::hypot(x.x, x.y)));
    return (1.0 - std::sin(0.5 * pi * x.z) + alpha * (1.0 + rho_r)) / (2.0 * (1.0 + alpha));
  }
  dvec3 gradient(const dvec3& x) const override {
    const double r = std::hypot(x.x, x.y);
    // (d rho_r / d r) / r, whose factor sin(pi r / 2) / r tends to pi / 2 at the axis.
    const double sine_over_r = r > 0.0 ? std::sin(0.5 * pi * r) / r : 0.5 * pi;
    const double radial = std::sin(2.0 * pi * f_M * std::cos(0.5 * pi * r)) * pi * pi * f_M * sine_over_r;
    const double scale = 1.0 / (2.0 * (1.0 + alpha));
    return scale * dvec3(alpha * radial * x.x, alpha * radial * x.y, -0.5 * pi * std::cos(0.5 * pi * x.z));
  }
  double isovalue() const override { return 0.5; }

 private:
  static constexpr double f_M = 6.0, alpha = 0.25;
};

/// R^2 - |x|^2.
class Sphere final : public Field {
 public:
  std::string_view name() const override { return "sphere"; }
  double value(const dvec3& x) const override { return R * R - glm::dot(x, x); }
  dvec3 gradient(const dvec3& x) const override { return -2.0 * x; }
  double isovalue() const override { return 0.0; }

 private:
  static constexpr double R = 0.8;
};

/// 4 R^2 (x^2 + y^2) - (|x|^2 + R^2 - r^2)^2.
class Torus final : public Field {
 public:
  std::string_view name() const override { return "torus"; }
  double value(const dvec3& x) const override {
    const double s = glm::dot(x, x) + R * R - r * r;
    return 4.0 * R * R * (x.x * x.x + x.y * x.y) - s * s;
  }
  dvec3 gradient(const dvec3& x) const override {
    const double s = glm::dot(x, x) + R * R - r * r;
    return 8.0 * R * R * dvec3(x.x, x.y, 0.0) - 4.0 * s * x;
  }
  double isovalue() const override { return 0.0; }

 private:
  static constexpr double R = 0.6, r = 0.25;
};

/// sin kx cos ky + sin ky cos kz + sin kz cos kx, k = 2 pi: two periods across [-1,1].
class Gyroid final : public Field {
 public:
  std::string_view name() const override { return "gyroid"; }
  double value(const dvec3& x) const override {
    const dvec3 s = glm::sin(k * x), c = glm::cos(k * x);
    return s.x * c.y + s.y * c.z + s.z * c.x;
  }
  dvec3 gradient(const dvec3& x) const override {
    const dvec3 s = glm::sin(k * x), c = glm::cos(k * x);
    return k * dvec3(c.x * c.y - s.z * s.x, c.y * c.z - s.x * s.y, c.z * c.x - s.y * s.z);
  }
  double isovalue() const override { return 0.0; }

 private:
  static constexpr double k = 2.0 * pi;
};

/// sin(5x + 2y) cos(4y - 3z + 0.3): waves along two directions in which no lattice is like itself.
class Waves final : public Field {
 public:
  std::string_view name() const override { return "waves"; }
  double value(const dvec3& x) const override { return std::sin(first(x)) * std::cos(second(x)); }
  dvec3 gradient(const dvec3& x) const override {
    const double along_first = std::cos(first(x)) * std::cos(second(x)), along_second = -std::sin(first(x)) * std::sin(second(x));
    return {5.0 * along_first, 2.0 * along_first + 4.0 * along_second, -3.0 * along_second};
  }
  double isovalue() const override { return 0.0; }

 private:
  static double first(const dvec3& x) { return 5.0 * x.x + 2.0 * x.y; }
  static double second(const dvec3& x) { return 4.0 * x.y - 3.0 * x.z + 0.3; }
};

/// sum of a_ijk x^i y^j z^k over i + j + k <= 4, every a_ijk uniform in [-1,1].
class Quartic final : public Field {
 public:
  explicit Quartic(unsigned seed) {
    std::mt19937 random(seed);
    // Not std::uniform_real_distribution, whose numbers differ from one library to another.
    for (auto& plane : a_)
      for (auto& row : plane)
        for (double& a : row) a = 2.0 * (double(random()) / 4294967295.0) - 1.0;
  }
  std::string_view name() const override { return "quartic"; }
  double value(const dvec3& x) const override {
    double sum = 0.0;
    for_each_term(x, [&](double a, const Powers& p, int i, int j, int k) { sum += a * p[i].x * p[j].y * p[k].z; });
    return sum;
  }
  dvec3 gradient(const dvec3& x) const override {
    dvec3 sum(0.0);
    for_each_term(x, [&](double a, const Powers& p, int i, int j, int k) {
      if (i > 0) sum.x += a * i * p[i - 1].x * p[j].y * p[k].z;
      if (j > 0) sum.y += a * j * p[i].x * p[j - 1].y * p[k].z;
      if (k > 0) sum.z += a * k * p[i].x * p[j].y * p[k - 1].z;
    });
    return sum;
  }
  /// The value at the origin, so that the surface passes through the middle of the cube.
  double isovalue() const override { return a_[0][0][0]; }

 private:
  struct Powers {
    std::array<dvec3, 5> of;
    const dvec3& operator[](int n) const { return of[std::size_t(n)]; }
  };
  template <class Term>
  void for_each_term(const dvec3& x, Term term) const {
    const Powers p{{dvec3(1.0), x, x * x, x * x * x, x * x * (x * x)}};
    for (int k = 0; k <= 4; ++k)
      for (int j = 0; j + k <= 4; ++j)
        for (int i = 0; i + j + k <= 4; ++i) term(a_[k][j][i], p, i, j, k);
  }
  double a_[5][5][5];
};

}  // namespace

const std::vector<std::string_view>& field_names() {
  static const std::vector<std::string_view> names{"marschner-lobb", "sphere", "torus", "gyroid", "waves", "quartic"};
  return names;
}

std::unique_ptr<Field> make_field(std::string_view name, unsigned seed) {
  if (name == "marschner-lobb") return std::make_unique<MarschnerLobb>();
  if (name == "sphere") return std::make_unique<Sphere>();
  if (name == "torus") return std::make_unique<Torus>();
  if (name == "gyroid") return std::make_unique<Gyroid>();
  if (name == "waves") return std::make_unique<Waves>();
  if (name == "quartic") return std::make_unique<Quartic>(seed);
  throw InputError(fmt::format("unknown field '{}', expected one of {}", name, fmt::join(field_names(), ", ")));
}

}  // namespace quincunx

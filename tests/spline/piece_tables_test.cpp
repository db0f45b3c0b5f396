// shaders/<name>_tables.glsl compiled as C++, in double and in float, against the Bernstein form; and what rounding can do in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "spline/tetrahedron.h"
#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

struct Tables {
  double value = 0.0;             // at a
  glm::dvec3 gradient{0.0};       // there
  std::vector<double> bernstein;  // along a..b
  double value_rounding = 0.0, bernstein_rounding = 0.0;  // units of e m (Rounded)
};

/// A number that knows what it is made of: a linear form of the samples, the values it may have where they are at most 1, and
/// the sum of the largest roundings of the operations that lead to it, in units of e = 2^-24.
struct Rounded {
  std::map<int, double> form;  // of the samples; number -1 is a constant
  double rounding = 0.0;

  Rounded() = default;
  explicit Rounded(double constant) : form{{-1, constant}} {}
  double largest() const {
    double sum = 0.0;
    for (const auto& [sample, weight] : form) sum += std::abs(weight);
    return sum;
  }
  bool is_constant() const { return form.size() == 1 && form.begin()->first == -1; }
  Rounded rounded() && {
    rounding += largest();
    return std::move(*this);
  }
};
Rounded scaled(Rounded a, double s) {
  for (auto& [sample, weight] : a.form) weight *= s;
  a.rounding *= std::abs(s);
  return a;
}
Rounded operator+(Rounded a, const Rounded& b) {
  for (const auto& [sample, weight] : b.form) a.form[sample] += weight;
  a.rounding += b.rounding;
  return std::move(a).rounded();
}
Rounded operator-(const Rounded& a, const Rounded& b) { return a + scaled(b, -1.0); }
Rounded operator-(const Rounded& a) { return scaled(a, -1.0); }
/// One of them is a constant: a coordinate, which is exact.
Rounded operator*(const Rounded& a, const Rounded& b) {
  return (a.is_constant() ? scaled(b, a.form.at(-1)) : scaled(a, b.form.at(-1))).rounded();
}
Rounded operator*(double a, const Rounded& b) {
  int exponent;
  return std::frexp(a, &exponent) == 0.5 ? scaled(b, a) : scaled(b, a).rounded();
}

double number(double f) { return f; }
double number(const Rounded&) { return 0.0; }
double error(double) { return 0.0; }
double error(const Rounded& f) { return f.rounding; }

template <class Number>
struct Samples {
  const Coefficients<double>& c;
  Number operator[](int n) const {
    if constexpr (std::is_same_v<Number, Rounded>) {
      Rounded sample;
      sample.form[n] = 1.0;
      return sample;
    } else {
      return Number(c.data[std::size_t(n)]);
    }
  }
};

#define PIECE_FLOAT [[maybe_unused]] Number
#define COEFFICIENT(number) data[number]
#define RESTRICT(...) PIECE_RESTRICT(__VA_ARGS__)

struct Bcc4Tables {
#include "shaders/bcc4_tables.glsl"
#define PIECE_BERNSTEIN p0, p1
#include "tests/spline/piece_tables.inc"
};
struct Bcc7Tables {
#include "shaders/bcc7_tables.glsl"
#define PIECE_BERNSTEIN p0, p1, p2, p3, p4
#include "tests/spline/piece_tables.inc"
};
struct Bcc8Tables {
#include "shaders/bcc8_tables.glsl"
#define PIECE_BERNSTEIN p0, p1, p2, p3, p4, p5
#include "tests/spline/piece_tables.inc"
};

/// A spline's tables and what they may lose.
struct TablesOf {
  std::string name;
  Tables (*in_double)(const Coefficients<double>&, const Tetrahedron&, const glm::dvec3&, const glm::dvec3&);
  Tables (*in_float)(const Coefficients<double>&, const Tetrahedron&, const glm::dvec3&, const glm::dvec3&);
  Tables (*rounded)(const Coefficients<double>&, const Tetrahedron&, const glm::dvec3&, const glm::dvec3&);
  double value_bits, slope_bits;  // floats: units of 2^-24 of the samples' range that a value and a derivative lose
  double rounding;                // of a value or a Bernstein coefficient, at most, units of e m: what bounds allow for (accel/kuhn_bounds.cpp)
};

template <class Of>
TablesOf tables_of(const std::string& name, double value_bits, double slope_bits, double rounding) {
  return {name, Of::template tables<double>, Of::template tables<float>, Of::template tables<Rounded>, value_bits, slope_bits, rounding};
}

const TablesOf kTables[] = {
    tables_of<Bcc4Tables>("bcc4", 4, 4, 16),
    tables_of<Bcc7Tables>("bcc7", 5, 25, 170),
    tables_of<Bcc8Tables>("bcc8", 8, 50, 256),
};

class PieceTables : public testing::TestWithParam<TablesOf> {
 protected:
  std::unique_ptr<Spline> spline = make_spline(GetParam().name);
  Extents extents{3, 4, 5};
  Coefficients<double> c = spline->coefficients(random_volume(LatticeKind::bcc, extents, 1), Spline::Prefilter::none);
  Random random{2};

  /// Some mean of the vertices.
  glm::dvec3 inside(const Tetrahedron& t) {
    glm::dvec3 b(0.0);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double weight = random.between(0.0, 1.0);
      b += weight * glm::dvec3(t.vertex(i));
      sum += weight;
    }
    return b / sum;
  }

  /// Largest differences from the Bernstein form over random segments in random tetrahedra, samples in [-1,1].
  template <class Function>
  Tables largest_differences(const Function& tables) {
    Tables largest;
    for (int n = 0; n < 5000; ++n) {
      const glm::dvec3 a = random.point(glm::dvec3(0.0), glm::dvec3(domain_max(LatticeKind::bcc, extents)));
      const glm::ivec3 cell(glm::floor(a));
      const Tetrahedron t = locate(cell, a);
      const glm::dvec3 b = inside(t);
      const Tables got = tables(c, t, a, b);
      const Jet jet = spline->evaluate(c, a);
      std::vector<double> bernstein(got.bernstein.size());
      spline->restrict_to_segment(c, cell, a, b, bernstein);
      largest.value = std::max(largest.value, std::abs(got.value - jet.value));
      largest.gradient = glm::max(largest.gradient, glm::abs(got.gradient - jet.gradient));
      largest.bernstein.resize(bernstein.size());
      for (std::size_t m = 0; m < bernstein.size(); ++m)
        largest.bernstein[m] = std::max(largest.bernstein[m], std::abs(got.bernstein[m] - bernstein[m]));
    }
    return largest;
  }
};

TEST_P(PieceTables, AreTheSplineInEveryTetrahedron) {
  const Tables d = largest_differences(GetParam().in_double);
  EXPECT_LT(d.value, 2e-15);
  for (int a = 0; a < 3; ++a) EXPECT_LT(d.gradient[a], 1e-14);
  for (const double difference : d.bernstein) EXPECT_LT(difference, 2e-15);
}

TEST_P(PieceTables, LoseFewBitsInFloats) {
  const Tables d = largest_differences(GetParam().in_float);
  EXPECT_LT(d.value, GetParam().value_bits * 0x1p-24);
  for (int a = 0; a < 3; ++a) EXPECT_LT(d.gradient[a], GetParam().slope_bits * 0x1p-24);
  for (const double difference : d.bernstein) EXPECT_LT(difference, GetParam().value_bits * 0x1p-24);
}

TEST_P(PieceTables, CanLoseLittleWhateverTheSamplesAre) {
  // Every operation off by as much as a float may be, all in one direction: over segments between vertices, where results are largest, and others.
  const Tetrahedron t = locate({2, 2, 2}, {2.7, 2.5, 2.3});
  double value = 0.0, bernstein = 0.0;
  const auto look = [&](const glm::dvec3& a, const glm::dvec3& b) {
    const Tables r = GetParam().rounded(c, t, a, b);
    value = std::max(value, r.value_rounding), bernstein = std::max(bernstein, r.bernstein_rounding);
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i != j) look(glm::dvec3(t.vertex(i)), glm::dvec3(t.vertex(j)));
  for (int n = 0; n < 20; ++n) look(inside(t), inside(t));
  RecordProperty("value", std::to_string(value));
  RecordProperty("bernstein", std::to_string(bernstein));
  EXPECT_LT(value, GetParam().rounding);
}

INSTANTIATE_TEST_SUITE_P(All, PieceTables, testing::ValuesIn(kTables), [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace quincunx

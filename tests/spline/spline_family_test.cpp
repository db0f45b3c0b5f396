// What every spline of the list promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "lattice/error.h"
#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

/// The supports of bcc4 and bcc8 are rhombic dodecahedra, |x_a| + |x_b| <= Reach.
template <int Reach>
double dodecahedron_gauge(const glm::dvec3& x) {
  const glm::dvec3 a = glm::abs(x);
  return (a.x + a.y + a.z - std::min({a.x, a.y, a.z})) / Reach;
}

/// bcc7's support is the sum of its seven directions' segments: |x_a| <= 3, |x_a +- x_b| <= 4. Less than 1 inside.
double bcc7_gauge(const glm::dvec3& x) {
  const glm::dvec3 a = glm::abs(x);
  const double largest = std::max({a.x, a.y, a.z}), least = std::min({a.x, a.y, a.z});
  return std::max(largest / 3.0, (a.x + a.y + a.z - least) / 4.0);
}

/// Cubes of half the edge TwiceReach / 2.
template <int TwiceReach>
double cube_gauge(const glm::dvec3& x) {
  const glm::dvec3 a = glm::abs(x);
  return 2.0 * std::max({a.x, a.y, a.z}) / TwiceReach;
}

double everywhere(const glm::dvec3&) { return 1.0; }

/// The sign of a product of functions that are negative where |x| > 1.
double lobes(const glm::dvec3& x) {
  const glm::dvec3 sign = glm::sign(1.0 - glm::abs(x));
  return sign.x * sign.y * sign.z;
}

enum class Cells { one_piece, cut };
enum class Gradient { continuous, jumps };

struct Expected {
  std::string_view name;
  double (*gauge)(const glm::dvec3& x);
  double reach;               // of the support, along each axis
  int reproduced;             // degree of the polynomials that the prefiltered spline reproduces
  int reproduced_unfiltered;  // the same without prefilter
  Cells cells;                // whether knot planes cut cells
  Gradient gradient;          // at knot planes
  double (*sign)(const glm::dvec3& x);  // of the generator inside its support
};
constexpr Expected kExpected[] = {
    {"bcc4", dodecahedron_gauge<2>, 2.0, 1, 1, Cells::cut, Gradient::jumps, everywhere},
    {"bcc7", bcc7_gauge, 3.0, 3, 1, Cells::cut, Gradient::continuous, everywhere},
    {"bcc8", dodecahedron_gauge<4>, 4.0, 3, 1, Cells::cut, Gradient::continuous, everywhere},
    {"bcc12", cube_gauge<8>, 4.0, 3, 1, Cells::one_piece, Gradient::continuous, everywhere},
    {"cwlb", cube_gauge<4>, 2.0, 1, 1, Cells::one_piece, Gradient::jumps, everywhere},
    {"trilinear", cube_gauge<2>, 1.0, 1, 1, Cells::one_piece, Gradient::jumps, everywhere},
    {"triquadratic", cube_gauge<3>, 1.5, 2, 1, Cells::cut, Gradient::continuous, everywhere},
    {"tricubic", cube_gauge<4>, 2.0, 3, 1, Cells::one_piece, Gradient::continuous, everywhere},
    {"catmull-rom", cube_gauge<4>, 2.0, 2, 2, Cells::one_piece, Gradient::continuous, lobes},
};

class SplineFamily : public testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override {
    for (const Expected& e : kExpected)
      if (e.name == GetParam()) expected = &e;
    ASSERT_NE(expected, nullptr) << "no expectations for " << GetParam();
    spline = make_spline(GetParam());
  }
  const Expected* expected = nullptr;
  std::unique_ptr<Spline> spline;
};

TEST_P(SplineFamily, HasTheExactValuesAndGradientsOfTheRecursion) {
  std::ifstream file(QUINCUNX_SOURCE_DIR "/tests/spline/box_spline_values.csv");
  int compared = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(std::string(GetParam()) + ",", 0) != 0) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    std::string name;
    glm::dvec3 x, gradient;
    double value;
    fields >> name >> x.x >> x.y >> x.z >> value >> gradient.x >> gradient.y >> gradient.z;
    ASSERT_TRUE(fields) << line;
    const Jet jet = spline->generator(x);
    EXPECT_NEAR(jet.value, value, 1e-14) << line;
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(jet.gradient[a], gradient[a], 1e-14) << line;
    ++compared;
  }
  EXPECT_EQ(compared, 40);
}

TEST_P(SplineFamily, SumsToOneOverTheLattice) {
  Random random(1);
  for (int n = 0; n < 300; ++n) {
    const glm::dvec3 x = random.point(glm::dvec3(-2.0), glm::dvec3(2.0));
    double sum = 0.0;
    glm::dvec3 gradient(0.0);
    for_lattice_points(spline->lattice(), x, expected->reach, [&](int, const glm::i64vec3&, const glm::dvec3& j) {
      const Jet jet = spline->generator(x - j);
      sum += jet.value;
      gradient += jet.gradient;
    });
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_LT(glm::length(gradient), 1e-14);
  }
}

TEST_P(SplineFamily, IsInvariantUnderThe48SymmetriesOfTheCube) {
  Random random(2);
  for (int n = 0; n < 100; ++n) {
    const glm::dvec3 x = random.point(glm::dvec3(-expected->reach), glm::dvec3(expected->reach));
    const Jet jet = spline->generator(x);
    glm::ivec3 axis(0, 1, 2);
    do {
      for (int signs = 0; signs < 8; ++signs) {
        const auto image = [&](const glm::dvec3& v) {
          return glm::dvec3(v[axis.x] * (signs & 1 ? -1 : 1), v[axis.y] * (signs & 2 ? -1 : 1),
                            v[axis.z] * (signs & 4 ? -1 : 1));
        };
        const Jet other = spline->generator(image(x));
        EXPECT_NEAR(other.value, jet.value, 1e-15);
        EXPECT_LT(glm::distance(other.gradient, image(jet.gradient)), 2e-15);
      }
    } while (std::next_permutation(&axis.x, &axis.x + 3));
  }
}

TEST_P(SplineFamily, HasItsSignInsideItsSupportAndIsZeroOutside) {
  Random random(3);
  int inside = 0, outside = 0;
  for (int n = 0; n < 4000; ++n) {
    const glm::dvec3 x = random.point(glm::dvec3(-1.2 * expected->reach), glm::dvec3(1.2 * expected->reach));
    const double gauge = expected->gauge(x);
    const Jet jet = spline->generator(x);
    if (gauge < 0.99) {
      EXPECT_GT(jet.value * expected->sign(x), 0.0);
      ++inside;
    } else if (gauge > 1.0) {
      EXPECT_TRUE(jet.value == 0.0 && jet.gradient == glm::dvec3(0.0)) << gauge;
      ++outside;
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 1000);
}

TEST_P(SplineFamily, HasTheDerivativeAsItsGradient) {
  // Inside one polynomial piece of degree <= 6 two Richardson steps on central differences are exact but for rounding, and for cosines off by
  // h^6 times a seventh derivative of some hundreds, a 300,000th of that.
  Random random(4);
  const double h = spline->polynomial() ? 0.02 : 0.01;
  for (int n = 0; n < 300; ++n) {
    const glm::dvec3 x = random.point(glm::dvec3(-expected->reach), glm::dvec3(expected->reach));
    if (knot_distance(x) < 2.0 * h) continue;
    const glm::dvec3 gradient = spline->generator(x).gradient;
    for (int a = 0; a < 3; ++a) {
      const auto difference = [&](double step) {
        glm::dvec3 d(0.0);
        d[a] = step;
        return (spline->generator(x + d).value - spline->generator(x - d).value) / (2.0 * step);
      };
      const double d1 = difference(h), d2 = difference(h / 2), d3 = difference(h / 4);
      const double e1 = (4.0 * d2 - d1) / 3.0, e2 = (4.0 * d3 - d2) / 3.0;
      EXPECT_NEAR(gradient[a], (16.0 * e2 - e1) / 15.0, 2e-13);
    }
  }
}

TEST_P(SplineFamily, EvaluatesTheSumOfItsShiftedGenerators) {
  const Extents extents(3, 4, 5);
  const Volume volume = random_volume(spline->lattice(), extents, 5);
  for (const auto prefilter : {Spline::Prefilter::none, Spline::Prefilter::automatic}) {
    const auto c = spline->coefficients(volume, prefilter);
    const glm::dvec3 last(domain_max(spline->lattice(), extents));
    Random random(6);
    for (int n = 0; n < 500; ++n) {
      glm::dvec3 u = random.point(glm::dvec3(0.0), last);
      // Every other point on knot planes, edges and vertices; some of them on the domain's border.
      if (n % 2 == 1) u = glm::round(u * 4.0) / 4.0;
      if (n % 4 == 1) u = glm::round(u);
      Jet sum;
      for_lattice_points(spline->lattice(), u, expected->reach,
                         [&](int coset, const glm::i64vec3& index, const glm::dvec3& j) {
                           const auto clamped = glm::clamp(index, glm::i64vec3(0), extents - std::int64_t(1));
                           const Jet jet = spline->generator(u - j);
                           sum.value += c.data[c.number(coset, clamped)] * jet.value;
                           sum.gradient += c.data[c.number(coset, clamped)] * jet.gradient;
                         });
      const Jet jet = spline->evaluate(c, u);
      EXPECT_NEAR(jet.value, sum.value, 1e-14);
      // Where gradients jump, that on the far border is the last cell's; the sum's belongs to a cell beyond.
      if (expected->gradient == Gradient::jumps && glm::any(glm::equal(u, last))) continue;
      EXPECT_LT(glm::distance(jet.gradient, sum.gradient), 1e-14) << u.x << " " << u.y << " " << u.z;
    }
  }
}

/// Largest error of the spline of the samples of x^a y^b z^c over all a + b + c = degree, in the middle of a volume;
/// the polynomials are at most 1 there.
double monomial_error(const Spline& spline, int degree, Spline::Prefilter prefilter) {
  const Extents extents(7);  // no border reaches the middle
  const glm::dvec3 middle = 0.5 * glm::dvec3(domain_max(spline.lattice(), extents)), centre = glm::floor(middle);
  double largest = 0.0;
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b) {
      // Integers, so that float samples are exact.
      const auto f = [&](const glm::dvec3& u) {
        return std::pow(u.x - centre.x, a) * std::pow(u.y - centre.y, b) * std::pow(u.z - centre.z, degree - a - b);
      };
      const auto c = spline.coefficients(volume_of(spline.lattice(), extents, f), prefilter);
      Random random(7);
      for (int n = 0; n < 20; ++n) {
        const glm::dvec3 u = random.point(middle - 0.5, middle + 0.5);
        largest = std::max(largest, std::abs(spline.evaluate(c, u).value - f(u)));
      }
    }
  return largest;
}

TEST_P(SplineFamily, ReproducesPolynomialsUpToItsDegreeAndNotOneMore) {
  for (int degree = 0; degree <= expected->reproduced; ++degree)
    EXPECT_LT(monomial_error(*spline, degree, Spline::Prefilter::automatic), 1e-11) << "degree " << degree;
  EXPECT_GT(monomial_error(*spline, expected->reproduced + 1, Spline::Prefilter::automatic), 1e-2);
}

TEST_P(SplineFamily, ReproducesFewerPolynomialsWithoutPrefilter) {
  for (int degree = 0; degree <= expected->reproduced_unfiltered; ++degree)
    EXPECT_LT(monomial_error(*spline, degree, Spline::Prefilter::none), 1e-11) << "degree " << degree;
  EXPECT_GT(monomial_error(*spline, expected->reproduced_unfiltered + 1, Spline::Prefilter::none), 1e-2);
}

/// A value of Bernstein form at t.
double bernstein_value(std::vector<double> b, double t) {
  for (std::size_t n = b.size() - 1; n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) b[i] = (1.0 - t) * b[i] + t * b[i + 1];
  return b[0];
}

/// The finite difference of order degree + 1 of s at evenly spaced points of the ray from t0 to t1: 0 for one piece.
double highest_difference(const Spline& spline, const Coefficients<double>& c, const glm::dvec3& o, const glm::dvec3& d,
                          double t0, double t1) {
  const int order = spline.degree() + 1;
  double sum = 0.0, binomial = 1.0;
  for (int n = 0; n <= order; ++n) {
    sum += (n % 2 ? -1.0 : 1.0) * binomial * spline.evaluate(c, o + (t0 + (t1 - t0) * n / order) * d).value;
    binomial = binomial * (order - n) / (n + 1);
  }
  return std::abs(sum);
}

TEST_P(SplineFamily, IsOnePolynomialBetweenSplitsWhichTheSegmentHolds) {
  if (!spline->polynomial()) return;
  const Extents extents(3);
  const auto c =
      spline->coefficients(random_volume(spline->lattice(), extents, 8), Spline::Prefilter::automatic);
  const glm::dvec3 cells(domain_max(spline->lattice(), extents));
  // The difference of the highest order adds up 2^order roundings.
  const double rounding = 4e-15 * std::exp2(spline->degree() + 1);
  Random random(9);
  double across = 0.0;
  for (int n = 0; n < 400; ++n) {
    const glm::ivec3 cell(random.point(glm::dvec3(0.0), cells));
    const glm::dvec3 a = random.point(cell, cell + 1), b = random.point(cell, cell + 1);
    // A parameter that is not the segment's own: b - a = 0.5 d.
    const glm::dvec3 d = 2.0 * (b - a), o = a - 0.25 * d;
    std::vector<double> t = {0.25};
    spline->split(cell, o, d, 0.25, 0.75, t);
    t.push_back(0.75);
    for (std::size_t i = 1; i < t.size(); ++i) {
      ASSERT_LT(t[i - 1], t[i]);
      EXPECT_LT(highest_difference(*spline, c, o, d, t[i - 1], t[i]), rounding);
      std::vector<double> bernstein(std::size_t(spline->degree()) + 1);
      spline->restrict_to_segment(c, cell, o + t[i - 1] * d, o + t[i] * d, bernstein);
      for (int m = 0; m <= 6; ++m)
        EXPECT_NEAR(bernstein_value(bernstein, m / 6.0),
                    spline->evaluate(c, o + (t[i - 1] + (t[i] - t[i - 1]) * m / 6.0) * d).value, 1e-14);
    }
    if (t.size() > 2) across = std::max(across, highest_difference(*spline, c, o, d, t.front(), t.back()));
    EXPECT_TRUE(t.size() == 2 || expected->cells == Cells::cut);
  }
  if (expected->cells == Cells::cut) {
    EXPECT_GT(across, 1e-4) << "no split was ever needed";
  } else {
    // From cell to cell it is another polynomial.
    const glm::dvec3 o(0.0, 0.3, 0.4), d(2.0, 0.5, 0.2);
    EXPECT_GT(highest_difference(*spline, c, o, d, 0.0, 1.0), 1e-4);
  }
}

TEST_P(SplineFamily, SplitsKeepOutOfTheEndsAndOfWhatTheVectorHeld) {
  // The diagonal of cell (0,0,0) lies in all knot planes of bcc7 inside it, and meets those of triquadratic in the middle alone; a parallel ray
  // crosses none of them as far as it goes here.
  std::vector<double> t = {7.0};
  spline->split({0, 0, 0}, {0.1, 0.2, 0.3}, {1.0, 1.0, 1.0}, 0.0, 0.15, t);
  EXPECT_THAT(t, testing::ElementsAre(7.0));
  spline->split({0, 0, 0}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 0.0, 0.5, t);
  EXPECT_THAT(t, testing::ElementsAre(7.0));
  spline->split({0, 0, 0}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 0.5, 1.0, t);
  EXPECT_THAT(t, testing::ElementsAre(7.0));
}

TEST_P(SplineFamily, BoundsTheCurvatureOfSmoothPiecesThatMeetOnFaces) {
  if (spline->polynomial()) return;
  const Extents extents(4, 3, 5);
  const auto c = spline->coefficients(random_volume(spline->lattice(), extents, 10), Spline::Prefilter::automatic);
  const glm::dvec3 last(domain_max(spline->lattice(), extents));
  Random random(11);
  double closest = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const glm::ivec3 cell(random.point(glm::dvec3(0.0), last));
    glm::dvec3 u = random.point(cell, cell + 1);
    const glm::dvec3 d = random.point(glm::dvec3(-1.0), glm::dvec3(1.0));
    const Jet jet = spline->evaluate_piece(c, cell, u);
    EXPECT_EQ(jet.value, spline->evaluate(c, u).value);
    EXPECT_EQ(jet.gradient, spline->evaluate(c, u).gradient);
    // The second derivative along d from two gradients.
    const double h = 1e-5;
    u = glm::clamp(u, glm::dvec3(cell) + h, glm::dvec3(cell) + 1.0 - h);
    const double bend = glm::dot(spline->evaluate_piece(c, cell, u + h * d).gradient - spline->evaluate_piece(c, cell, u - h * d).gradient, d) / (2.0 * h);
    const double bound = spline->curvature(c, cell, d);
    EXPECT_LE(std::abs(bend), bound * (1.0 + 1e-9) + 1e-9);
    closest = std::max(closest, std::abs(bend) / bound);
    // The upper face of the cell, and the lower one of the next.
    const int axis = n % 3;
    u[axis] = cell[axis] + 1;
    glm::ivec3 next = cell;
    ++next[axis];
    if (next[axis] == int(last[axis])) continue;
    EXPECT_NEAR(spline->evaluate_piece(c, cell, u).value, spline->evaluate_piece(c, next, u).value, 1e-15);
  }
  EXPECT_GT(closest, 0.5) << "bounds are far too large";
}

INSTANTIATE_TEST_SUITE_P(List, SplineFamily, testing::ValuesIn(spline_names()),
                         [](const auto& instance) {
                           std::string name(instance.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(SplineList, MakesEverySplineUnderItsNameAndRefusesOthersNamingTheChoices) {
  for (const auto name : spline_names()) EXPECT_EQ(make_spline(name)->name(), name);
  try {
    make_spline("bcc77");
    FAIL() << "an unknown spline was made";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'bcc77'"));
    for (const auto name : spline_names()) EXPECT_THAT(error.what(), testing::HasSubstr(std::string(name)));
  }
}

}  // namespace
}  // namespace quincunx

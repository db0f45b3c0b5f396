#include "accel/bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "coefficient_sets.h"
#include "float_piece.h"
#include "lattice/error.h"
#include "spline/bcc7.h"

namespace quincunx {
namespace {

/// The cells whose closure holds u: 1, 2, 4 or 8 of them.
std::vector<glm::ivec3> cells_at(const glm::dvec3& u, const glm::i64vec3& cells) {
  std::vector<glm::ivec3> found;
  const glm::i64vec3 low = glm::max(glm::i64vec3(glm::ceil(u)) - std::int64_t(1), glm::i64vec3(0));
  const glm::i64vec3 high = glm::min(glm::i64vec3(glm::floor(u)), cells - std::int64_t(1));
  for (std::int64_t z = low.z; z <= high.z; ++z)
    for (std::int64_t y = low.y; y <= high.y; ++y)
      for (std::int64_t x = low.x; x <= high.x; ++x) found.push_back({x, y, z});
  return found;
}

/// Random points, a third of them with some coordinates on faces of cells and some on planes between tetrahedra.
class Points {
 public:
  explicit Points(const glm::i64vec3& cells) : cells_(cells) {}
  glm::dvec3 next() {
    glm::dvec3 u;
    for (int a = 0; a < 3; ++a) {
      u[a] = uniform_(random_) * double(cells_[a]);
      if (random_() % 4 == 0) u[a] = std::round(u[a]);
      if (a > 0 && random_() % 6 == 0) u[a] = std::min(std::floor(u[a]) + (u[0] - std::floor(u[0])), double(cells_[a]));
    }
    return u;
  }
  /// What the rounding of a ray may do to a point: up to 4e-5 of a cell in each axis.
  glm::dvec3 shift() {
    return 4e-5 * (2.0 * glm::dvec3(uniform_(random_), uniform_(random_), uniform_(random_)) - 1.0);
  }

 private:
  glm::i64vec3 cells_;
  std::mt19937 random_{3};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

/// How often values are outside what the bounds say.
struct Check {
  std::size_t values = 0, violations = 0;

  void look(const CellBounds& bounds, const std::vector<glm::ivec3>& cells, double value) {
    for (const glm::ivec3& cell : cells) {
      const std::size_t n = bounds.number(cell);
      ++values;
      violations += !(bounds.value(bounds.min[n]) <= value && value <= bounds.value(bounds.max[n]));
    }
  }
};

/// Looks at the spline in double, and at what floats make of its value and of its Bernstein coefficients on a piece of
/// a ray, at displaced points, from each cell that the point belongs to, in the bounds of all of them.
Check check_bounds(const CellBounds& bounds, const Coefficients<float>& c, int points) {
  const Bcc7 spline;
  const Coefficients<double> exact = in_double(c);
  Points random(bounds.cells);
  Check check;
  for (int n = 0; n < points; ++n) {
    const glm::dvec3 u = random.next();
    const std::vector<glm::ivec3> cells = cells_at(u, bounds.cells);
    check.look(bounds, cells, spline.evaluate(exact, u).value);
    for (const glm::ivec3& cell : cells) {
      const glm::dvec3 middle = glm::dvec3(cell) + 0.5;
      const Tetrahedron tetrahedron = locate(cell, u + 1e-9 * (middle - u));
      const FloatPiece piece(c, tetrahedron);
      const glm::vec3 w(tetrahedron.frame(u + random.shift()));
      check.look(bounds, cells, double(piece.value(w)));
      // From u towards a corner of its tetrahedron: inside one piece.
      const glm::dvec3 towards = glm::mix(u, glm::dvec3(tetrahedron.vertex(n % 4)), n % 7 / 7.0) + random.shift();
      for (float b : piece.bernstein(w, glm::vec3(tetrahedron.frame(towards)))) check.look(bounds, {cell}, double(b));
    }
  }
  return check;
}

TEST(Bounds, HoldEveryValueInDoubleAndInFloatsInsideAndOnBoundariesOfCells) {
  std::size_t values = 0;
  for (const CoefficientSet& set : coefficient_sets()) {
    const CellBounds bounds = bcc7_bounds(set.c);
    const Check check = check_bounds(bounds, set.c, 8000);
    EXPECT_EQ(check.violations, 0u) << set.name << ", of " << check.values;
    values += check.values;
  }
  EXPECT_GT(values, 1000000u);
}

TEST(Bounds, TheCheckSeesBoundsThatAreTooTight) {
  // Without its margin, an interval about a constant is one number that floats miss; without its outermost
  // hundredth, one about noise misses values near its ends.
  const Coefficients<float> noise = coefficient_sets().front().c;
  CellBounds bounds = bcc7_bounds(noise);
  for (std::size_t n = 0; n < bounds.min.size(); ++n) {
    const int shrink = (bounds.max[n] - bounds.min[n]) / 100;
    bounds.min[n] = std::uint16_t(bounds.min[n] + shrink), bounds.max[n] = std::uint16_t(bounds.max[n] - shrink);
  }
  EXPECT_GT(check_bounds(bounds, noise, 8000).violations, 0u);

  const Coefficients<float> constant = make_coefficients({5, 4, 3}, [](int, const glm::i64vec3&) { return 0.7; });
  bounds = bcc7_bounds(constant);
  bounds.low = double(0.7f), bounds.step = 0.0;
  EXPECT_GT(check_bounds(bounds, constant, 1000).violations, 0u);
}

TEST(Bounds, ErrorsOfFloatsAreATenthOfTheEvaluationMarginWhereMostCancels) {
  // Errors of interpolated Bernstein coefficients where cancellation is worst, in units of 2^-24 of the largest
  // coefficient.
  const Bcc7 spline;
  double worst = 0.0;
  for (const CoefficientSet& set : coefficient_sets()) {
    if (set.name != "random signs" && set.name != "cosets of opposite sign" &&
        set.name != "checkerboard of both cosets")
      continue;
    const Coefficients<double> exact = in_double(set.c);
    const glm::i64vec3 cells = domain_max(set.c.lattice, set.c.extents);
    const double m = std::abs(set.c.data.front());
    Points random(cells);
    for (int n = 0; n < 10000; ++n) {
      const glm::ivec3 cell = cell_of(random.next(), cells);
      const Tetrahedron t = locate(cell, glm::dvec3(cell) + glm::fract(random.next()));
      const glm::vec3 a(0.75f, 0.5f, 0.125f), b(float(n % 64) / 64.0f + 0.015625f, 0.015625f, 0.0f);
      const auto point = [&](const glm::vec3& w) { return glm::dvec3(t.even) + t.gradient_from_frame(glm::dvec3(w)); };
      double truth[5];
      spline.restrict_to_segment(exact, cell, point(a), point(b), truth);
      const std::array<float, 5> found = FloatPiece(set.c, t).bernstein(a, b);
      for (std::size_t i = 0; i < 5; ++i)
        worst = std::max(worst, std::abs(double(found[i]) - truth[i]) / (m * 0x1p-24));
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GT(worst, 1.0);
  EXPECT_LT(worst, 51.2);
}

TEST(Bounds, AreAtMostFivePercentWiderThanTheRangeOfTheSpline) {
  const Bcc7 spline;
  const Coefficients<float> noisy = coefficient_sets().front().c;
  for (const Coefficients<float>& c : {noisy, smooth_coefficients({20, 21, 22})}) {
    const CellBounds bounds = bcc7_bounds(c);
    const Coefficients<double> exact = in_double(c);
    std::mt19937 random(5);
    double ratio = 0.0;
    constexpr int kCells = 40, kSteps = 10;
    for (int n = 0; n < kCells; ++n) {
      const glm::i64vec3 cell(random() % bounds.cells.x, random() % bounds.cells.y, random() % bounds.cells.z);
      double low = std::numeric_limits<double>::max(), high = -low;
      for (int z = 0; z <= kSteps; ++z)
        for (int y = 0; y <= kSteps; ++y)
          for (int x = 0; x <= kSteps; ++x) {
            const double f = spline.evaluate(exact, glm::dvec3(cell) + glm::dvec3(x, y, z) / double(kSteps)).value;
            low = std::min(low, f), high = std::max(high, f);
          }
      const std::size_t i = bounds.number(cell);
      ratio += (bounds.value(bounds.max[i]) - bounds.value(bounds.min[i])) / (high - low) / kCells;
    }
    EXPECT_LT(ratio, 1.05);
    EXPECT_GE(ratio, 1.0);
  }
}

TEST(Bounds, OfAConstantAreNoWiderThanRoundingAsks) {
  const CellBounds bounds = bcc7_bounds(make_coefficients({4, 4, 4}, [](int, const glm::i64vec3&) { return -500.0; }));
  for (std::size_t n = 0; n < bounds.min.size(); ++n) {
    EXPECT_LE(bounds.value(bounds.min[n]), -500.0);
    EXPECT_GE(bounds.value(bounds.max[n]), -500.0);
    EXPECT_LT(bounds.value(bounds.max[n]) - bounds.value(bounds.min[n]), 500.0 * 1e-4);
  }
}

TEST(Bounds, OneSampleAlongAnAxisMakesOneCell) {
  EXPECT_EQ(bcc7_bounds(make_coefficients({1, 1, 1}, [](int, const glm::i64vec3&) { return 1.0; })).cells,
            glm::i64vec3(1));
  EXPECT_EQ(bcc7_bounds(make_coefficients({2, 1, 5}, [](int, const glm::i64vec3&) { return 1.0; })).cells,
            glm::i64vec3(3, 1, 9));
}

TEST(Bounds, ReportProgressUpToOneAndStopWhenAsked) {
  const Coefficients<float> c = smooth_coefficients({20, 20, 20});
  double last = 0.0;
  bcc7_bounds(c, [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  });
  EXPECT_EQ(last, 1.0);
  EXPECT_THROW(bcc7_bounds(c, [](double) { throw Interrupted(); }), Interrupted);
}

}  // namespace
}  // namespace quincunx

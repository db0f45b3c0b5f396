#include "accel/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "coefficient_sets.h"
#include "float_kernel.h"
#include "lattice/error.h"

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
  explicit Points(const glm::i64vec3& domain) : domain_(domain) {}
  glm::dvec3 next() {
    glm::dvec3 u;
    for (int a = 0; a < 3; ++a) {
      u[a] = uniform_(random_) * double(domain_[a]);
      if (random_() % 4 == 0) u[a] = std::round(u[a]);
      if (a > 0 && random_() % 6 == 0) u[a] = std::min(std::floor(u[a]) + (u[0] - std::floor(u[0])), double(domain_[a]));
    }
    return u;
  }
  /// What the rounding of a ray may do to a point: up to 4e-5 of a cell in each axis.
  glm::dvec3 shift() {
    return 4e-5 * (2.0 * glm::dvec3(uniform_(random_), uniform_(random_), uniform_(random_)) - 1.0);
  }

 private:
  glm::i64vec3 domain_;
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
/// a ray, at displaced points, from each cell that the point belongs to, in the bounds of all of them. The bounds are those of a box
/// of cells from `origin` on, in which `random` has points.
Check check_bounds(const Spline& spline, const CellBounds& bounds, const Coefficients<float>& c, int points, Points random,
                   const glm::ivec3& origin = glm::ivec3(0)) {
  const Coefficients<double> exact = in_double(c);
  const glm::i64vec3 all_cells = cell_count(c.lattice, c.extents);
  Check check;
  for (int n = 0; n < points; ++n) {
    const glm::dvec3 in_box = random.next(), u = in_box + glm::dvec3(origin);
    const std::vector<glm::ivec3> bounded = cells_at(in_box, bounds.cells);
    check.look(bounds, bounded, spline.evaluate(exact, u).value);
    for (const glm::ivec3& cell : cells_at(u, all_cells)) {
      const auto kernel = float_kernel(spline, c, cell, u + 1e-9 * (glm::dvec3(cell) + 0.5 - u));
      check.look(bounds, bounded, double(kernel->value(u + random.shift())));
      // From u towards a corner of its piece: inside one piece.
      const glm::dvec3 towards = glm::mix(u, kernel->vertex(n), n % 7 / 7.0);
      if (std::find(bounded.begin(), bounded.end(), cell - origin) == bounded.end()) continue;
      for (float b : kernel->bernstein(u + random.shift(), towards + random.shift())) check.look(bounds, {cell - origin}, double(b));
    }
  }
  return check;
}

Check check_bounds(const Spline& spline, const CellBounds& bounds, const Coefficients<float>& c, int points) {
  return check_bounds(spline, bounds, c, points, Points(domain_max(c.lattice, c.extents)));
}

class Bounds : public testing::TestWithParam<std::string_view> {
 protected:
  std::unique_ptr<Spline> spline = make_spline(GetParam());
  LatticeKind lattice = spline->lattice();
};

TEST_P(Bounds, HoldEveryValueInDoubleAndInFloatsInsideAndOnBoundariesOfCells) {
  std::size_t values = 0;
  for (const CoefficientSet& set : coefficient_sets(lattice)) {
    const CellBounds bounds = cell_bounds(*spline, set.c);
    const Check check = check_bounds(*spline, bounds, set.c, 8000);
    EXPECT_EQ(check.violations, 0u) << set.name << ", of " << check.values;
    values += check.values;
  }
  EXPECT_GT(values, 1000000u);
}

TEST_P(Bounds, TheCheckSeesBoundsThatAreTooTight) {
  // Without its margin, an interval about a constant is one number that floats miss; without its outermost
  // hundredth, one about noise misses values near its ends.
  const Coefficients<float> noise = coefficient_sets(lattice).front().c;
  CellBounds bounds = cell_bounds(*spline, noise);
  for (std::size_t n = 0; n < bounds.min.size(); ++n) {
    const int shrink = (bounds.max[n] - bounds.min[n]) / 100;
    bounds.min[n] = std::uint16_t(bounds.min[n] + shrink), bounds.max[n] = std::uint16_t(bounds.max[n] - shrink);
  }
  EXPECT_GT(check_bounds(*spline, bounds, noise, 8000).violations, 0u);

  const Coefficients<float> constant = make_coefficients({5, 4, 3}, [](int, const glm::i64vec3&) { return 0.7; }, lattice);
  bounds = cell_bounds(*spline, constant);
  bounds.low = double(0.7f), bounds.step = 0.0;
  EXPECT_GT(check_bounds(*spline, bounds, constant, 1000).violations, 0u);
}

/// A tenth to a twentieth of K, in units of 2^-24 of the largest coefficient.
double allowed_error(std::string_view spline) {
  return spline == "bcc4" ? 12.8 : spline == "bcc7" || spline == "bcc8" ? 51.2 : spline == "trilinear" ? 15.0 : 25.0;
}

TEST_P(Bounds, ErrorsOfFloatsAreAFractionOfTheEvaluationMarginWhereMostCancels) {
  // Errors of Bernstein coefficients where cancellation is worst.
  double worst = 0.0;
  for (const CoefficientSet& set : coefficient_sets(lattice)) {
    if (set.name != "random signs" && set.name != "cosets of opposite sign" && set.name != "checkerboard of every coset") continue;
    const Coefficients<double> exact = in_double(set.c);
    const glm::i64vec3 last = domain_max(lattice, set.c.extents);
    const double m = std::abs(set.c.data.front());
    Points random(last);
    for (int n = 0; n < 10000; ++n) {
      const glm::ivec3 cell = cell_of(random.next(), last);
      const glm::dvec3 inside = glm::dvec3(cell) + glm::fract(random.next());
      const auto kernel = float_kernel(*spline, set.c, cell, inside);
      // Two places with few binary digits in the simplex of a piece's first vertices.
      const double s = n % 64 / 64.0 + 0.015625;
      const glm::dvec3 v0 = kernel->vertex(0), v1 = kernel->vertex(1), v2 = kernel->vertex(2), v3 = kernel->vertex(3);
      const glm::dvec3 a = 0.25 * v0 + 0.25 * v1 + 0.375 * v2 + 0.125 * v3, b = (1.0 - s) * v0 + (s - 0.015625) * v1 + 0.015625 * v2;
      std::vector<double> truth(std::size_t(spline->degree()) + 1);
      spline->restrict_to_segment(exact, cell, a, b, truth);
      const std::vector<float> found = kernel->bernstein(a, b);
      for (std::size_t i = 0; i < truth.size(); ++i) worst = std::max(worst, std::abs(double(found[i]) - truth[i]) / (m * 0x1p-24));
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GE(worst, GetParam() == "bcc4" ? 0.0 : 0.5);  // of bcc4 nothing is rounded at such places
  EXPECT_LT(worst, allowed_error(GetParam()));
}

/// How much wider than the spline's range the bounds are on average: the tricubic net has 4 points along an axis for pieces of
/// degree 3, that of bcc7 5 for degree 4, and they hold on to the cell's vertices less.
double allowed_width(std::string_view spline) { return spline == "tricubic" ? 1.15 : 1.05; }

TEST_P(Bounds, AreHardlyWiderThanTheRangeOfTheSpline) {
  const Coefficients<float> noisy = coefficient_sets(lattice).front().c;
  for (const Coefficients<float>& c : {noisy, smooth_coefficients({20, 21, 22}, lattice)}) {
    const CellBounds bounds = cell_bounds(*spline, c);
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
            const double f = spline->evaluate(exact, glm::dvec3(cell) + glm::dvec3(x, y, z) / double(kSteps)).value;
            low = std::min(low, f), high = std::max(high, f);
          }
      const std::size_t i = bounds.number(cell);
      ratio += (bounds.value(bounds.max[i]) - bounds.value(bounds.min[i])) / (high - low) / kCells;
    }
    EXPECT_LT(ratio, allowed_width(GetParam()));
    EXPECT_GE(ratio, 1.0);
  }
}

TEST_P(Bounds, OfAConstantAreNoWiderThanRoundingAsks) {
  const CellBounds bounds = cell_bounds(*spline, make_coefficients({4, 4, 4}, [](int, const glm::i64vec3&) { return -500.0; }, lattice));
  for (std::size_t n = 0; n < bounds.min.size(); ++n) {
    EXPECT_LE(bounds.value(bounds.min[n]), -500.0);
    EXPECT_GE(bounds.value(bounds.max[n]), -500.0);
    EXPECT_LT(bounds.value(bounds.max[n]) - bounds.value(bounds.min[n]), 500.0 * 1e-4);
  }
}

TEST_P(Bounds, OneSampleAlongAnAxisMakesOneCell) {
  const auto one = [](int, const glm::i64vec3&) { return 1.0; };
  EXPECT_EQ(cell_bounds(*spline, make_coefficients({1, 1, 1}, one, lattice)).cells, glm::i64vec3(1));
  EXPECT_EQ(cell_bounds(*spline, make_coefficients({2, 1, 5}, one, lattice)).cells,
            lattice == LatticeKind::bcc ? glm::i64vec3(3, 1, 9) : glm::i64vec3(1, 1, 4));
}

TEST_P(Bounds, ReportProgressUpToOneAndStopWhenAsked) {
  const Coefficients<float> c = smooth_coefficients({20, 20, 20}, lattice);
  double last = 0.0;
  cell_bounds(*spline, c, [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  });
  EXPECT_EQ(last, 1.0);
  EXPECT_THROW(cell_bounds(*spline, c, [](double) { throw Interrupted(); }), Interrupted);
}

// ---- boxes of a volume, one by one ----

/// Coefficients of an index box, whose apron repeats the border.
Coefficients<float> cut_out(const Coefficients<float>& c, const glm::i64vec3& low, const glm::i64vec3& high) {
  return make_coefficients(high - low, [&](int coset, const glm::i64vec3& index) { return c.data[c.number(coset, low + index)]; },
                           c.lattice);
}

/// The least and the largest a sample may be for coefficients within those of c: what a prefilter that makes no new extremes has.
BoundsScale scale_for(const Spline& spline, const Coefficients<float>& c) {
  const auto [low, high] = std::minmax_element(c.data.begin(), c.data.end());
  return bounds_scale(spline, Spline::Prefilter::none, *low, *high, cell_count(c.lattice, c.extents));
}

/// The bounds of the cells of a box whose coefficients all lie in it: `inner` fewer than there are, on every side.
CellBounds inner_bounds(const CellBounds& all, std::int64_t inner) {
  CellBounds bounds = all;
  bounds.cells = all.cells - 2 * inner;
  for (std::int64_t z = 0; z < bounds.cells.z; ++z)
    for (std::int64_t y = 0; y < bounds.cells.y; ++y)
      for (std::int64_t x = 0; x < bounds.cells.x; ++x) {
        const std::size_t from = all.number(glm::i64vec3(x, y, z) + inner), to = bounds.number({x, y, z});
        bounds.min[to] = all.min[from], bounds.max[to] = all.max[from];
      }
  return bounds;
}

TEST_P(Bounds, OfABoxCutOutHoldWhateverIsAroundIt) {
  const glm::i64vec3 low(1, 2, 1), high(7, 8, 7);
  // Around a box of ones, what is as large as can be.
  const auto hidden = [&](int, const glm::i64vec3& p) {
    return glm::all(glm::greaterThanEqual(p, low)) && glm::all(glm::lessThan(p, high)) ? 1.0 : 1e6;
  };
  std::vector<CoefficientSet> sets = coefficient_sets(lattice);
  sets.push_back({"hidden wall", make_coefficients({9, 9, 9}, hidden, lattice)});
  std::size_t values = 0;
  for (const CoefficientSet& set : sets) {
    if (glm::any(glm::lessThan(set.c.extents, high))) continue;
    const BoundsScale scale = scale_for(*spline, set.c);
    const CellBounds all = cell_bounds(*spline, cut_out(set.c, low, high), scale);
    EXPECT_EQ(all.low, scale.low);
    EXPECT_EQ(all.step, scale.step);
    const std::int64_t step = lattice_step(lattice), inner = step * spline->apron();
    const CellBounds bounds = inner_bounds(all, inner);
    const Check check = check_bounds(*spline, bounds, set.c, 8000, Points(bounds.cells), glm::ivec3(step * low + inner));
    EXPECT_EQ(check.violations, 0u) << set.name << ", of " << check.values;
    values += check.values;
  }
  EXPECT_GT(values, 300000u);
}

TEST(BoundsOfBoxes, OfTheQuarticAllowForRoundingOfTheLargestCoefficientThatMayBeAround) {
  // Zeros in a volume that goes up to a million: K = 512, which is more than a step of the 16 bits, so that it can be seen.
  const std::unique_ptr<Spline> spline = make_spline("bcc7");
  const Coefficients<float> zeros = make_coefficients({4, 4, 4}, [](int, const glm::i64vec3&) { return 0.0; });
  const BoundsScale scale = bounds_scale(*spline, Spline::Prefilter::automatic, 0.0, 1e6, {99, 99, 99});
  const double margin = 511.0 * 0x1p-24 * scale.most;
  ASSERT_GT(margin, scale.step);
  const CellBounds bounds = cell_bounds(*spline, zeros, scale);
  for (std::size_t n = 0; n < bounds.min.size(); ++n) {
    EXPECT_LT(bounds.value(bounds.min[n]), -margin);
    EXPECT_GT(bounds.value(bounds.max[n]), margin);
  }
}

TEST_P(Bounds, HaveAScaleForEverythingThatThePrefilterMakesOfSamplesAndLittleMore) {
  // Samples of either extreme, as the prefilter's weights at one lattice point have signs: the coefficient there is extreme.
  Volume volume;
  volume.lattice = lattice;
  volume.extents = {5, 5, 5};
  const double least = 10.0, most = 50.0;
  std::vector<float> samples(std::size_t(coset_count(lattice) * 125));
  const glm::ivec3 centre = lattice_step(lattice) * glm::ivec3(2);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const int coset = int(n / 125);
    const glm::ivec3 d = glm::abs(lattice_step(lattice) * glm::ivec3(n % 5, n / 5 % 5, n / 25 % 5) + coset - centre);
    const int others = (d.x != 0) + (d.y != 0) + (d.z != 0);
    const bool positive = lattice == LatticeKind::bcc ? others == 0 : others % 2 == 0;
    samples[n] = float(positive ? most : least);
  }
  volume.samples = samples;
  const Coefficients<float> c = spline->coefficients_float(volume, Spline::Prefilter::automatic);
  const BoundsScale scale = bounds_scale(*spline, Spline::Prefilter::automatic, least, most, cell_count(lattice, volume.extents));
  const double largest = *std::max_element(c.data.begin(), c.data.end());
  EXPECT_LE(largest, scale.most);
  EXPECT_GT(largest, scale.most - 1e-3);
  // The scale is symmetric about the middle of the samples, and holds every interval of the bounds.
  EXPECT_NEAR(scale.most + scale.least, least + most, 1e-9);
  EXPECT_LE(scale.value(0), scale.least);
  EXPECT_GE(scale.value(65535), scale.most);
}

INSTANTIATE_TEST_SUITE_P(List, Bounds, testing::ValuesIn(spline_names()),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace quincunx

#include "render/tracer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "volumes.h"

namespace quincunx {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Tracer::Config kExact{};

/// r^2 - |u - centre|^2.
QuadraticSpline ball(const glm::dvec3& centre, double r) {
  return QuadraticSpline([=](const glm::dvec3& u) {
    return Jet{r * r - glm::dot(u - centre, u - centre), -2.0 * (u - centre)};
  });
}

/// The crossings of the ball's surface (isovalue 0) in a domain of 7^3 cells.
std::vector<double> ball_crossings(const glm::dvec3& centre, double r, const glm::dvec3& eye, const glm::dvec3& d) {
  const QuadraticSpline spline = ball(centre, r);
  const auto c = QuadraticSpline::domain({4, 4, 4}, 64.0);
  return crossing_distances(Tracer(spline, c, std::array{0.0}, nullptr, kExact), c, eye, d);
}

TEST(Tracer, FindsSpheresOfASampledQuadraticWhereTheClosedFormSaysTheyAre) {
  // bcc7 with its prefilter reproduces quadratics away from the border; the ball stays 5.5 cells off it.
  const glm::dvec3 centre(11.5, 11.25, 11.75);
  const double r = 5.75;
  World world;
  world.origin = {-7.0, 2.0, 30.0};
  world.axes = glm::dmat3(0.25);
  const Sampled ball(
      bcc_volume({12, 12, 12}, [&](const glm::dvec3& u) { return r * r - glm::dot(u - centre, u - centre); }, world));
  const Tracer tracer(*ball.spline, ball.coefficients, std::array{0.0}, nullptr, kExact);
  const glm::dvec3 middle = world.to_world(centre);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int hits = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const glm::dvec3 eye = middle + 20.0 * random_direction(random);
    const glm::dvec3 target = middle + 1.2 * 0.25 * r * glm::dvec3(uniform(random), uniform(random), uniform(random));
    const glm::dvec3 d = glm::normalize(target - eye);
    const double nearest = glm::dot(middle - eye, d);
    const double below = glm::dot(middle - eye, middle - eye) - nearest * nearest, rr = 0.0625 * r * r;
    if (std::abs(rr - below) < 1e-4) continue;  // near tangency the place itself is badly conditioned
    const auto found = crossing_distances(tracer, ball.coefficients, eye, d);
    if (below > rr) {
      EXPECT_THAT(found, IsEmpty());
      continue;
    }
    const double half = std::sqrt(rr - below);
    ASSERT_THAT(found, ElementsAre(DoubleNear(nearest - half, 1e-10), DoubleNear(nearest + half, 1e-10)));
    // The normal there is the radius.
    const glm::dvec3 x = eye + found[0] * d;
    const glm::dvec3 g = world.gradient_to_world(
        ball.spline->evaluate(ball.coefficients, world.to_lattice(x)).gradient);
    EXPECT_LT(glm::length(glm::cross(glm::normalize(g), glm::normalize(x - middle))), 1e-10);
    ++hits;
  }
  EXPECT_GT(hits, 2000);
}

/// A cubic with small integer coefficients, so that its samples are exact floats.
struct Cubic {
  std::array<int, 20> a{};
  double operator()(const glm::dvec3& u) const {
    const glm::dvec3 x = u - 11.0;
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i <= 3; ++i)
      for (int j = 0; i + j <= 3; ++j)
        for (int k = 0; i + j + k <= 3; ++k) sum += a[n++] * std::pow(x.x, i) * std::pow(x.y, j) * std::pow(x.z, k);
    return sum;
  }
};

/// The places in [0, end] where the cubic through values at 0, 1/3, 2/3, 1 of `end` changes sides: between its extrema.
std::vector<double> cubic_crossings(const std::function<double(double)>& f, double end) {
  const double y0 = f(0), y1 = f(end / 3), y2 = f(2 * end / 3), y3 = f(end);
  const double c1 = -5.5 * y0 + 9 * y1 - 4.5 * y2 + y3, c2 = 9 * y0 - 22.5 * y1 + 18 * y2 - 4.5 * y3,
               c3 = -4.5 * y0 + 13.5 * y1 - 13.5 * y2 + 4.5 * y3;
  std::vector<double> ends{0.0, 1.0};
  const double disc = c2 * c2 - 3 * c1 * c3;
  if (disc > 0.0)
    for (const double sign : {-1.0, 1.0}) {
      const double x = (-c2 + sign * std::sqrt(disc)) / (3 * c3);
      if (x > 0.0 && x < 1.0) ends.push_back(x);
    }
  std::sort(ends.begin(), ends.end());
  std::vector<double> found;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    double a = ends[i] * end, b = ends[i + 1] * end;
    if ((f(a) >= 0.0) == (f(b) >= 0.0)) continue;
    const bool above = f(a) >= 0.0;
    for (int n = 0; n < 60; ++n) ((f(0.5 * (a + b)) >= 0.0) == above ? a : b) = 0.5 * (a + b);
    found.push_back(0.5 * (a + b));
  }
  return found;
}

TEST(Tracer, FindsEveryCrossingOfSampledCubics) {
  std::mt19937 random(12);
  std::uniform_int_distribution<int> digit(-3, 3);
  std::uniform_real_distribution<double> inside(6.0, 17.0);
  int compared = 0, three = 0;
  for (int surface = 0; surface < 10; ++surface) {
    Cubic f;
    for (int& a : f.a) a = digit(random);
    const Sampled sampled(bcc_volume({12, 12, 12}, f));
    const Tracer tracer(*sampled.spline, sampled.coefficients, std::array{0.0}, nullptr, kExact);
    for (int trial = 0; trial < 200; ++trial) {
      // From one point of the zone that the border does not spoil to another.
      const glm::dvec3 from(inside(random), inside(random), inside(random));
      const glm::dvec3 to(inside(random), inside(random), inside(random));
      const double end = glm::length(to - from);
      const glm::dvec3 d = (to - from) / end;
      const auto expected = cubic_crossings([&](double s) { return f(from + s * d); }, end);
      auto found = crossing_distances(tracer, sampled.coefficients, from, d);
      std::erase_if(found, [&](double s) { return s > end; });
      // Skip rays whose answer hangs on rounding: crossings at their ends, or nearly double ones.
      bool fair = std::abs(f(from)) > 1e-6 && std::abs(f(to)) > 1e-6;
      for (const double s : expected) fair = fair && std::abs(f(from + (s + 1e-4) * d) - f(from + (s - 1e-4) * d)) > 1e-4;
      if (!fair) continue;
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], expected[i], 1e-9);
        ++compared;
      }
      three += found.size() == 3;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(three, 10);
}

TEST(Tracer, TouchingFromBelowIsACrossingThereAndBack) {
  // The ray y = 3, z = 3 touches balls of radius 2 about (x,1,3) at x: on a lattice plane and within a cell.
  for (const double x : {3.0, 3.3, 3.5}) {
    const auto found = ball_crossings({x, 1, 3}, 2, {-10, 3, 3}, {1, 0, 0});
    EXPECT_THAT(found, ElementsAre(DoubleNear(10 + x, 1e-6), DoubleNear(10 + x, 1e-6)));
  }
  EXPECT_THAT(ball_crossings({3.3, 1, 3}, 2 - 1e-9, {-10, 3, 3}, {1, 0, 0}), IsEmpty());
  const double half = std::sqrt(2 * 2e-9);
  EXPECT_THAT(ball_crossings({3.3, 1, 3}, 2 + 1e-9, {-10, 3, 3}, {1, 0, 0}),
              ElementsAre(DoubleNear(13.3 - half, 1e-8), DoubleNear(13.3 + half, 1e-8)));
}

TEST(Tracer, TouchingFromAboveIsNoCrossing) {
  for (const double x : {3.0, 3.3, 3.5}) {
    const auto crossings = [&](double r) {
      const QuadraticSpline spline([&](const glm::dvec3& u) {
        const glm::dvec3 v = u - glm::dvec3(x, 1, 3);
        return Jet{glm::dot(v, v) - r * r, 2.0 * v};
      });
      const auto c = QuadraticSpline::domain({4, 4, 4}, 64.0);
      return crossing_distances(Tracer(spline, c, std::array{0.0}, nullptr, kExact), c, {-10, 3, 3}, {1, 0, 0});
    };
    EXPECT_THAT(crossings(2.0), IsEmpty()) << x;
    EXPECT_EQ(crossings(2.0 + 1e-9).size(), 2u) << x;
  }
}

TEST(Tracer, ARayThatStartsAboveIsNotCappedAndCrossesOnTheWayOut) {
  EXPECT_THAT(ball_crossings({3, 3, 3}, 2, {3.5, 3, 3}, {1, 0, 0}), ElementsAre(DoubleNear(1.5, 1e-13)));
  // A ball that reaches over the border: the ray enters the domain inside it.
  EXPECT_THAT(ball_crossings({0, 3, 3}, 2, {-10, 3, 3}, {1, 0, 0}), ElementsAre(DoubleNear(12, 1e-13)));
}

TEST(Tracer, AnEyeOnTheSurfaceIsAboveIt) {
  // On the ball's surface f equals the isovalue: above. Outwards the ray leaves there, inwards only on the far side.
  EXPECT_THAT(ball_crossings({3, 3, 3}, 2, {5, 3, 3}, {1, 0, 0}), ElementsAre(DoubleNear(0, 1e-12)));
  EXPECT_THAT(ball_crossings({3, 3, 3}, 2, {5, 3, 3}, {-1, 0, 0}), ElementsAre(DoubleNear(4, 1e-12)));
}

TEST(Tracer, CrossingsOnLatticePlanesEdgesAndPointsCountOnce) {
  // Balls through lattice points, along axes and diagonals that meet the surface exactly there.
  for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), {0, -1, 0}, {0, 0, 1}, {1, 1, 0}, {-1, 0, 1}, {1, 1, 1}, {-1, 1, -1}}) {
    const double r = glm::length(d);  // centre + d is a lattice point
    const glm::dvec3 centre(3, 4, 3), eye = centre - 50.0 * d;
    EXPECT_THAT(ball_crossings(centre, r, eye, d), ElementsAre(DoubleNear(49 * r, 1e-11), DoubleNear(51 * r, 1e-11)));
    EXPECT_THAT(ball_crossings(centre, 2 * r, eye, d),
                ElementsAre(DoubleNear(48 * r, 1e-11), DoubleNear(52 * r, 1e-11)));
  }
}

/// x - 3, computed `error` too low in even cells and too high in odd ones: the surface x = 3 is on a plane between two.
class RoundedRamp final : public Spline {
 public:
  explicit RoundedRamp(double error) : error_(error) {}
  std::string_view name() const override { return "rounded ramp"; }
  LatticeKind lattice() const override { return LatticeKind::bcc; }
  int degree() const override { return 1; }
  int apron() const override { return 0; }
  std::span<const Filter> filters() const override {
    static constexpr Filter none{Prefilter::none, 0, 1.0, 3};
    return {&none, 1};
  }
  std::string_view shader() const override { return ""; }
  Jet generator(const glm::dvec3&) const override { return {}; }
  Jet evaluate(const Coefficients<double>&, const glm::dvec3& u) const override { return {u.x - 3.0, {1.0, 0.0, 0.0}}; }
  void split(const glm::ivec3&, const glm::dvec3&, const glm::dvec3&, double, double,
             std::vector<double>&) const override {}
  void restrict_to_segment(const Coefficients<double>&, const glm::ivec3& cell, const glm::dvec3& a,
                           const glm::dvec3& b, std::span<double> bernstein) const override {
    const double error = cell.x % 2 == 0 ? -error_ : error_;
    bernstein[0] = a.x - 3.0 + error;
    bernstein[1] = b.x - 3.0 + error;
  }
  Coefficients<double> coefficients(const Volume&, Prefilter, const Progress&) const override { return {}; }
  Coefficients<float> coefficients_float(const Volume&, Prefilter, const ValueUnit&, const Progress&) const override { return {}; }

 private:
  double error_;
};

TEST(Tracer, ARootThatRoundingPutsBetweenTwoPiecesIsFoundOnce) {
  const auto c = QuadraticSpline::domain({4, 4, 4}, 1.0);
  for (const double error : {1e-12, -1e-12}) {
    const RoundedRamp spline(error);
    const Tracer tracer(spline, c, std::array{0.0}, nullptr, kExact);
    for (const double side : {1.0, -1.0})
      EXPECT_THAT(crossing_distances(tracer, c, {3.0 - 10.0 * side, 2.2, 2.7}, {side, 0, 0}),
                  ElementsAre(DoubleNear(10, 1e-11)))
          << error;
  }
}

TEST(Tracer, ARootThatRoundingPutsBetweenASkippedCellAndTheNextIsFound) {
  // Bounds that let every cell below x = 3 be skipped, below the isovalue.
  CellBounds bounds;
  bounds.cells = glm::i64vec3(7);
  bounds.low = -8.0;
  bounds.step = 0x1p-12;
  for (int n = 0; n < 343; ++n) {
    const bool below = n % 7 < 3;
    bounds.min.push_back(below ? 0 : (8 << 12) - 1);
    bounds.max.push_back(below ? (8 << 12) - 1 : 0xffff);
  }
  const auto c = QuadraticSpline::domain({4, 4, 4}, 1.0);
  const RoundedRamp spline(1e-12);
  const Tracer tracer(spline, c, std::array{0.0}, &bounds, kExact);
  EXPECT_THAT(crossing_distances(tracer, c, {-7, 2.2, 2.7}, {1, 0, 0}), ElementsAre(DoubleNear(10, 1e-11)));
}

TEST(Tracer, ConstantVolumesHoldNoSurface) {
  for (const double value : {0.1, 100.0, -3.3, 0.0, 1e30}) {
    const Sampled constant(bcc_volume({5, 5, 5}, [&](const glm::dvec3&) { return value; }));
    const double sample = float(value);
    const double unit = std::max(1.0, std::abs(value));
    std::mt19937 random(4);
    for (const double isovalue : {sample - unit, sample, sample + unit}) {
      const Tracer tracer(*constant.spline, constant.coefficients, std::array{isovalue}, nullptr, kExact);
      for (int trial = 0; trial < 200; ++trial) {
        const glm::dvec3 d = random_direction(random);
        EXPECT_THAT(crossing_distances(tracer, constant.coefficients, glm::dvec3(4.5) - 30.0 * d, d), IsEmpty());
      }
    }
  }
}

TEST(Tracer, APlateauThatEqualsTheIsovalueIsAboveIt) {
  // 0 below x = 8, 1 from there on: far from the step the spline is flat at exactly 0 and 1.
  const Sampled step(bcc_volume({10, 4, 4}, [](const glm::dvec3& u) { return u.x < 8.0 ? 0.0 : 1.0; }),
                     Spline::Prefilter::none);
  for (const double y : {2.0, 2.3, 3.5}) {
    const auto crossings = [&](double isovalue) {
      const Tracer tracer(*step.spline, step.coefficients, std::array{isovalue}, nullptr, kExact);
      return crossing_distances(tracer, step.coefficients, {-5, y, 2.9}, {1, 0, 0});
    };
    EXPECT_THAT(crossings(0.0), IsEmpty()) << "0 is above 0 everywhere";
    EXPECT_EQ(crossings(0.5).size(), 1u);
    EXPECT_EQ(crossings(1.0).size(), 1u) << "arrives at 1 and stays";
  }
}

TEST(Tracer, SeveralIsovaluesAreCrossedInTheirOrderAlongTheRay) {
  // f = 9 - (x - 3)^2 along the axis: up through 1, 5, 8, down through 8, 5, 1.
  const QuadraticSpline spline([](const glm::dvec3& u) {
    return Jet{9.0 - (u.x - 3.0) * (u.x - 3.0), {-2.0 * (u.x - 3.0), 0.0, 0.0}};
  });
  const auto c = QuadraticSpline::domain({4, 4, 4}, 16.0);
  for (const Intersect intersect : {Intersect::exact, Intersect::march}) {
    const Tracer tracer(spline, c, std::array{1.0, 5.0, 8.0}, nullptr, {intersect, 2.5});
    const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, {-1, 2.2, 3.1}), {1, 0, 0});
    Tracer::Workspace work;
    RayCost cost;
    std::vector<int> surfaces;
    std::vector<double> places;
    tracer.trace(*ray, work, cost, [&](const Crossing& crossing) {
      surfaces.push_back(crossing.surface);
      places.push_back(crossing.s);
      return true;
    });
    EXPECT_THAT(surfaces, ElementsAre(0, 1, 2, 2, 1, 0));
    const double a = std::sqrt(8.0);
    EXPECT_THAT(places, ElementsAre(DoubleNear(3 - a, 1e-12), DoubleNear(1, 1e-12), DoubleNear(2, 1e-12),
                                    DoubleNear(4, 1e-12), DoubleNear(5, 1e-12), DoubleNear(3 + a, 1e-12)));
  }
}

TEST(Tracer, StopsWhenTheVisitorHasEnough) {
  const QuadraticSpline spline = ball({3, 3, 3}, 2);
  const auto c = QuadraticSpline::domain({4, 4, 4}, 64.0);
  const Tracer tracer(spline, c, std::array{0.0}, nullptr, kExact);
  const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, {-1, 3, 3}), {1, 0, 0});
  Tracer::Workspace work;
  RayCost cost;
  int visits = 0;
  tracer.trace(*ray, work, cost, [&](const Crossing&) { return ++visits < 1; });
  EXPECT_EQ(visits, 1);
  EXPECT_EQ(cost.steps, 1u) << "the surface at x = 1 is met at the end of the first cell";
}

TEST(Tracer, MarchSamplesFromTheEntryAndMissesWhatLiesBetweenSamples) {
  // Above the isovalue from x = 2.9 to 3.5 only.
  const auto crossings = [](double step) {
    const QuadraticSpline spline = ball({3.2, 3, 3}, 0.3);
    const auto c = QuadraticSpline::domain({4, 4, 4}, 64.0);
    const Tracer tracer(spline, c, std::array{0.0}, nullptr, {Intersect::march, step});
    return crossing_distances(tracer, c, {-1, 3, 3}, {1, 0, 0});
  };
  const auto both = ElementsAre(DoubleNear(3.9, 1e-12), DoubleNear(4.5, 1e-12));
  EXPECT_THAT(crossings(1.0), both) << "sample at 3";
  EXPECT_THAT(crossings(1.2), IsEmpty()) << "samples at 2.4 and 3.6";
  EXPECT_THAT(crossings(2.0), IsEmpty()) << "samples at 2 and 4";
  EXPECT_THAT(crossings(3.4), both);
}

TEST(Tracer, MarchAlsoSamplesTheExit) {
  // The ball reaches over the far side: only the exit point at x = 7 is inside.
  const QuadraticSpline spline = ball({8, 3, 3}, 1.5);
  const auto c = QuadraticSpline::domain({4, 4, 4}, 64.0);
  const Tracer tracer(spline, c, std::array{0.0}, nullptr, {Intersect::march, 3.0});
  EXPECT_THAT(crossing_distances(tracer, c, {-1, 3, 3}, {1, 0, 0}), ElementsAre(DoubleNear(7.5, 1e-12)));
}

TEST(Tracer, MarchEndsAtTheExit) {
  // The ray leaves the domain at (7,3,3); the ball lies further along the face, where clamped samples would slide to.
  const QuadraticSpline spline = ball({7, 5.5, 3}, 1.0);
  const auto c = QuadraticSpline::domain({4, 4, 4}, 64.0);
  const Tracer tracer(spline, c, std::array{0.0}, nullptr, {Intersect::march, 5.0});
  EXPECT_THAT(crossing_distances(tracer, c, {5, 1, 3}, {1, 1, 0}), IsEmpty());
}

}  // namespace
}  // namespace quincunx

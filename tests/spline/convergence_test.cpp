// How fast the error falls when the spacing does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

/// A smooth function of the unit cube.
double smooth(const glm::dvec3& x) {
  return std::sin(5.0 * x.x + 2.0 * x.y) * std::cos(4.0 * x.y - 3.0 * x.z + 0.3) + x.z * x.x;
}

/// RMS error in the middle of the unit cube at spacing 1/cells.
double rms_error(const Spline& spline, int cells, Spline::Prefilter prefilter) {
  const double h = 1.0 / cells;
  const Extents extents(cells / lattice_step(spline.lattice()) + 1);
  const auto c = spline.coefficients(
      volume_of(spline.lattice(), extents, [&](const glm::dvec3& u) { return smooth(h * u); }), prefilter);
  Random random(1);
  double sum = 0.0;
  const int points = 4000;
  for (int n = 0; n < points; ++n) {
    const glm::dvec3 x = random.point(glm::dvec3(0.4), glm::dvec3(0.6));
    const double error = spline.evaluate(c, x / h).value - smooth(x);
    sum += error * error;
  }
  return std::sqrt(sum / points);
}

struct Order {
  std::string_view name;
  double with_prefilter, without;
  int coarsest;  // cells of the unit cube's edge
};
// Of triquadratic with its prefilter the error of the fourth order, which falls faster, is the larger one on coarse grids.
constexpr Order kOrders[] = {{"bcc7", 4.0, 2.0, 16}, {"bcc12", 4.0, 2.0, 16}, {"trilinear", 2.0, 2.0, 16}, {"triquadratic", 3.0, 2.0, 48}, {"tricubic", 4.0, 2.0, 16}, {"catmull-rom", 3.0, 3.0, 16}};

TEST(Convergence, HasItsApproximationOrderWithPrefilterAndWithout) {
  ASSERT_EQ(std::size(kOrders), spline_names().size());
  for (const Order& order : kOrders) {
    const auto spline = make_spline(order.name);
    for (const auto prefilter : {Spline::Prefilter::none, Spline::Prefilter::automatic}) {
      const double expected = prefilter == Spline::Prefilter::none ? order.without : order.with_prefilter;
      int cells = order.coarsest;
      double coarse = rms_error(*spline, cells, prefilter);
      while (cells < 72) {
        cells = cells * 3 / 2;
        const double fine = rms_error(*spline, cells, prefilter);
        const double measured = std::log(coarse / fine) / std::log(1.5);
        EXPECT_GT(measured, expected - 0.2) << order.name << " at 1/" << cells;
        EXPECT_LT(measured, expected + 0.2) << order.name << " at 1/" << cells;
        coarse = fine;
      }
    }
  }
}

TEST(Convergence, IsOfTheSameOrderWhereSamplesAreInterpolated) {
  // The grids are so fine that what the border changes, a factor of the pole a sample, is nothing in the middle.
  for (const Order& order : kOrders) {
    const auto spline = make_spline(order.name);
    const auto is_iir = [](const Spline::Filter& filter) { return filter.kind == Spline::Prefilter::iir; };
    if (std::none_of(spline->filters().begin(), spline->filters().end(), is_iir)) continue;
    const double coarse = rms_error(*spline, 48, Spline::Prefilter::iir), fine = rms_error(*spline, 72, Spline::Prefilter::iir);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(1.5), order.with_prefilter, 0.1) << order.name;
  }
}

}  // namespace
}  // namespace quincunx

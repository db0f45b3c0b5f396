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

TEST(Convergence, HasTheOrderThatEachPrefilterTells) {
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    for (const Spline::Filter& filter : spline->filters()) {
      // Of triquadratic, prefiltered, the error of the fourth order, which falls faster, is the larger one on coarse grids; and what the border changes of
      // an interpolation, a factor of the pole a sample, is nothing in the middle of fine ones.
      int cells = (name == "triquadratic" && filter.order == 3) || filter.kind == Spline::Prefilter::iir ? 48 : 16;
      double coarse = rms_error(*spline, cells, filter.kind);
      while (cells < 72) {
        cells = cells * 3 / 2;
        const double fine = rms_error(*spline, cells, filter.kind);
        const double measured = std::log(coarse / fine) / std::log(1.5);
        EXPECT_NEAR(measured, filter.order, 0.2) << name << " " << prefilter_name(filter.kind) << " at 1/" << cells;
        coarse = fine;
      }
    }
  }
}

}  // namespace
}  // namespace quincunx

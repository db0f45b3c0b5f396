#include "render/color_space.h"

#include <gtest/gtest.h>

namespace quincunx {
namespace {

void expect_near_color(const glm::dvec3& found, const glm::dvec3& expected, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
}

TEST(ColorSpace, InterpolatesAsVtkDoes) {
  struct Interpolated {
    ColorSpace space;
    glm::dvec3 a, b;
    double s;
    glm::dvec3 color;
  };
  // vtkColorTransferFunction::GetColor of VTK 9.1, whose matrices to and from CIELAB are inverse to 4 digits.
  const Interpolated cases[] = {
      {ColorSpace::hsv, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.3, {0.42074, 0.16341, 0.73800}},
      {ColorSpace::hsv, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.52, {0.65252, 0.11588, 0.72920}},
      {ColorSpace::hsv, {1, 0, 0}, {0, 0, 1}, 0.3, {0.80000, 1.00000, 0.00000}},
      {ColorSpace::hsv, {1, 0, 0}, {0, 0, 1}, 0.52, {0.00000, 1.00000, 0.08000}},
      {ColorSpace::hsv, {0, 0, 0}, {1, 1, 1}, 0.3, {0.30000, 0.30000, 0.30000}},
      {ColorSpace::hsv, {0, 0, 0}, {1, 1, 1}, 0.52, {0.52000, 0.52000, 0.52000}},
      {ColorSpace::hsv, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.3, {0.12896, 0.80888, 0.91500}},
      {ColorSpace::hsv, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.52, {0.15076, 0.31821, 0.92600}},
      {ColorSpace::hsv, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.3, {0.14950, 0.08445, 0.88500}},
      {ColorSpace::hsv, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.52, {0.07335, 0.87400, 0.75991}},
      {ColorSpace::hsv, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.3, {0.39633, 0.41000, 0.30067}},
      {ColorSpace::hsv, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.52, {0.31634, 0.56400, 0.30331}},
      {ColorSpace::hsv, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.3, {0.20425, 0.35500, 0.15059}},
      {ColorSpace::hsv, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.52, {0.35917, 0.54200, 0.31904}},
      {ColorSpace::hsv_wrap, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.3, {0.42074, 0.16341, 0.73800}},
      {ColorSpace::hsv_wrap, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.52, {0.65252, 0.11588, 0.72920}},
      {ColorSpace::hsv_wrap, {1, 0, 0}, {0, 0, 1}, 0.3, {1.00000, 0.00000, 0.60000}},
      {ColorSpace::hsv_wrap, {1, 0, 0}, {0, 0, 1}, 0.52, {0.96000, 0.00000, 1.00000}},
      {ColorSpace::hsv_wrap, {0, 0, 0}, {1, 1, 1}, 0.3, {0.30000, 0.30000, 0.30000}},
      {ColorSpace::hsv_wrap, {0, 0, 0}, {1, 1, 1}, 0.52, {0.52000, 0.52000, 0.52000}},
      {ColorSpace::hsv_wrap, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.3, {0.12896, 0.80888, 0.91500}},
      {ColorSpace::hsv_wrap, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.52, {0.15076, 0.31821, 0.92600}},
      {ColorSpace::hsv_wrap, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.3, {0.88500, 0.08445, 0.17952}},
      {ColorSpace::hsv_wrap, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.52, {0.87400, 0.07335, 0.09136}},
      {ColorSpace::hsv_wrap, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.3, {0.41000, 0.30067, 0.37447}},
      {ColorSpace::hsv_wrap, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.52, {0.51968, 0.30331, 0.56400}},
      {ColorSpace::hsv_wrap, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.3, {0.20425, 0.35500, 0.15059}},
      {ColorSpace::hsv_wrap, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.52, {0.35917, 0.54200, 0.31904}},
      {ColorSpace::lab, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.3, {0.49495, 0.24579, 0.56270}},
      {ColorSpace::lab, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.52, {0.58901, 0.20030, 0.43043}},
      {ColorSpace::lab, {1, 0, 0}, {0, 0, 1}, 0.3, {0.88882, 0.00000, 0.35690}},
      {ColorSpace::lab, {1, 0, 0}, {0, 0, 1}, 0.52, {0.77870, 0.00000, 0.55311}},
      {ColorSpace::lab, {0, 0, 0}, {1, 1, 1}, 0.3, {0.27699, 0.27700, 0.27699}},
      {ColorSpace::lab, {0, 0, 0}, {1, 1, 1}, 0.52, {0.48615, 0.48616, 0.48615}},
      {ColorSpace::lab, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.3, {0.58281, 0.75646, 0.48094}},
      {ColorSpace::lab, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.52, {0.73332, 0.63592, 0.58849}},
      {ColorSpace::lab, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.3, {0.88635, 0.13839, 0.23667}},
      {ColorSpace::lab, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.52, {0.87557, 0.16068, 0.18785}},
      {ColorSpace::lab, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.3, {0.24233, 0.22956, 0.39426}},
      {ColorSpace::lab, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.52, {0.24806, 0.25127, 0.54572}},
      {ColorSpace::lab, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.3, {0.27319, 0.32200, 0.26102}},
      {ColorSpace::lab, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.52, {0.45612, 0.50613, 0.44674}},
      {ColorSpace::diverging, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.3, {0.61456, 0.74633, 0.99632}},
      {ColorSpace::diverging, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.52, {0.88733, 0.85556, 0.83759}},
      {ColorSpace::diverging, {1, 0, 0}, {0, 0, 1}, 0.3, {1.00000, 0.75310, 0.53782}},
      {ColorSpace::diverging, {1, 0, 0}, {0, 0, 1}, 0.52, {0.97718, 0.96091, 1.00000}},
      {ColorSpace::diverging, {0, 0, 0}, {1, 1, 1}, 0.3, {0.27699, 0.27700, 0.27699}},
      {ColorSpace::diverging, {0, 0, 0}, {1, 1, 1}, 0.52, {0.48615, 0.48616, 0.48615}},
      {ColorSpace::diverging, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.3, {0.78913, 1.00000, 0.77562}},
      {ColorSpace::diverging, {0.1, 0.9, 0.3}, {0.95, 0.2, 0.8}, 0.52, {1.00000, 0.95638, 0.95877}},
      {ColorSpace::diverging, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.3, {0.89358, 0.12017, 0.23643}},
      {ColorSpace::diverging, {0.9, 0.1, 0.3}, {0.85, 0.2, 0.05}, 0.52, {0.88414, 0.14261, 0.18728}},
      {ColorSpace::diverging, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.3, {0.39302, 0.37836, 0.47677}},
      {ColorSpace::diverging, {0.2, 0.2, 0.2}, {0.1, 0.3, 0.9}, 0.52, {0.47395, 0.45014, 0.68615}},
      {ColorSpace::diverging, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.3, {0.16547, 0.28883, 0.15035}},
      {ColorSpace::diverging, {0.05, 0.1, 0.02}, {0.9, 0.95, 0.9}, 0.52, {0.33317, 0.48483, 0.32111}},
      {ColorSpace::step, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.3, {0.71000, 0.01600, 0.15000}},
      {ColorSpace::step, {0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, 0.52, {0.71000, 0.01600, 0.15000}},
  };
  for (const Interpolated& c : cases) {
    SCOPED_TRACE(int(c.space));
    expect_near_color(interpolate(c.space, c.a, c.b, c.s), c.color, 4e-4);
  }
}

TEST(ColorSpace, BeginsAndEndsWithItsColours) {
  const glm::dvec3 colors[] = {{0, 0, 0}, {1, 1, 1}, {0.2, 0.9, 0.4}, {1, 0, 0.5}, {0.5, 0.5, 0.5}};
  for (const ColorSpace space : {ColorSpace::rgb, ColorSpace::hsv, ColorSpace::hsv_wrap, ColorSpace::lab, ColorSpace::diverging, ColorSpace::step})
    for (const glm::dvec3& a : colors)
      for (const glm::dvec3& b : colors) {
        expect_near_color(interpolate(space, a, b, 0.0), a, 4e-4);
        expect_near_color(interpolate(space, a, b, 1.0), b, 4e-4);
      }
}

TEST(ColorSpace, OfDisplaysIsUndoneByItsInverse) {
  for (double x = 0.0; x <= 1.0; x += 1.0 / 256.0) expect_near_color(srgb_from_linear(linear_from_srgb({x, x * x, 0.04})), {x, x * x, 0.04}, 1e-7);
  EXPECT_NEAR(linear_from_srgb(glm::dvec3(188.0 / 255.0)).x, 0.5029, 1e-4);  // the grey that gives half the light
}

}  // namespace
}  // namespace quincunx

#include "bench/frame_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace quincunx {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// A picture of hits at depth 10 facing the viewer, white.
Frame white(int width, int height) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  Frame frame{width, height, std::vector<float>(4 * pixels, 1.0f), std::vector<float>(pixels, 10.0f), std::vector<float>(3 * pixels, 0.0f), {}};
  for (std::size_t p = 0; p < pixels; ++p) frame.normal[3 * p + 2] = 1.0f;
  return frame;
}

/// Linear grey.
void paint(Frame& frame, std::size_t p, double grey) {
  for (std::size_t a = 0; a < 3; ++a) frame.color[4 * p + a] = float(grey);
}

FrameErrors compare(const Frame& frame, const Frame& reference, double cell, const FrameComparison::Counts& counts = {}) {
  FrameComparison comparison;
  comparison.add(frame, reference, [cell](std::size_t) { return cell; }, counts);
  return comparison.errors();
}

TEST(FrameErrors, TellLostFalseAndStrayHitsApartAndLeaveThemOutOfTheDepths) {
  Frame reference = white(4, 2), frame = reference;
  frame.depth[0] = kNothing;                         // missed
  reference.depth[1] = kNothing;                     // false
  reference.depth[2] = frame.depth[2] = kNothing;    // nothing in both
  frame.depth[3] = 11.5f;                            // 0.75 cells: another sheet
  frame.depth[4] = 10.5f;                            // 0.25 cells
  const FrameErrors e = compare(frame, reference, 2.0);
  EXPECT_EQ(e.compared, 7u);
  EXPECT_EQ(e.expected, 6u);
  EXPECT_EQ(e.missed, 1u);
  EXPECT_EQ(e.false_hits, 1u);
  EXPECT_EQ(e.wrong_sheet, 1u);
  EXPECT_DOUBLE_EQ(e.wrong_percent(), 300.0 / 7.0);
  EXPECT_NEAR(e.depth_rms, 0.25 / std::sqrt(4.0), 1e-7);  // of the four that are left
  EXPECT_NEAR(e.depth_max, 0.25, 1e-7);
  EXPECT_EQ(e.normal_rms, 0.0);
}

TEST(FrameErrors, MeasureTheAngleBetweenNormals) {
  Frame reference = white(2, 1), frame = reference;
  frame.normal[0] = 1.0f, frame.normal[2] = 0.0f;
  const FrameErrors e = compare(frame, reference, 1.0);
  EXPECT_NEAR(e.normal_rms, 90.0 / std::sqrt(2.0), 1e-5);
  EXPECT_NEAR(e.normal_p99, 0.99 * 90.0, 1e-4);
}

TEST(FrameErrors, LeaveOutWhatDoesNotCount) {
  Frame reference = white(3, 1), frame = reference;
  frame.depth[0] = kNothing, frame.depth[1] = 10.25f;
  const FrameErrors e = compare(frame, reference, 1.0, [](std::size_t p) { return p == 2; });
  EXPECT_EQ(e.compared, 1u);
  EXPECT_EQ(e.wrong() + std::uint64_t(e.depth_max > 0.0), 0u);
}

TEST(ImageErrors, AreOfColoursAsAScreenShowsThem) {
  Frame a = white(12, 12), b = a;
  EXPECT_EQ(image_rmse(a, b), 0.0);
  for (std::size_t p = 0; p < b.depth.size(); ++p) paint(b, p, 0.21404114);  // sRGB 0.5
  EXPECT_NEAR(image_rmse(a, b), 0.5, 1e-6);
}

TEST(StructuralSimilarity, OfOnePictureIsOneAndOfFlatOnesTheLuminanceTerm) {
  Frame a = white(13, 12), b = a;
  EXPECT_DOUBLE_EQ(structural_similarity(a, b), 1.0);
  for (std::size_t p = 0; p < b.depth.size(); ++p) paint(b, p, 0.21404114);
  const double x = 1.0, y = 0.5, c1 = 1e-4;
  EXPECT_NEAR(structural_similarity(a, b), (2 * x * y + c1) / (x * x + y * y + c1), 1e-6);
  EXPECT_THROW(structural_similarity(white(10, 30), white(10, 30)), std::logic_error);
}

TEST(StructuralSimilarity, IsTheMeanOfItsDefinitionOverAllWindows) {
  // Noise, two pictures of 14 x 13: window by window, by sums over pixels with weights of both axes.
  const int width = 14, height = 13;
  Frame a = white(width, height), b = a;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> x, y;
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  for (std::size_t p = 0; p < a.depth.size(); ++p) {
    x.push_back(uniform(random)), y.push_back(0.5 * x.back() + 0.5 * uniform(random));
    paint(a, p, linear(x.back())), paint(b, p, linear(y.back()));
  }
  double sum = 0.0;
  int windows = 0;
  for (int top = 0; top + 11 <= height; ++top)
    for (int left = 0; left + 11 <= width; ++left) {
      double w = 0, mx = 0, my = 0, vx = 0, vy = 0, cov = 0;
      for (int pass = 0; pass < 2; ++pass)
        for (int j = 0; j < 11; ++j)
          for (int i = 0; i < 11; ++i) {
            const double g = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2.0 * 1.5 * 1.5));
            const std::size_t p = std::size_t((top + j) * width + left + i);
            if (pass == 0) {
              w += g, mx += g * x[p], my += g * y[p];
            } else {
              vx += g * std::pow(x[p] - mx, 2) / w, vy += g * std::pow(y[p] - my, 2) / w, cov += g * (x[p] - mx) * (y[p] - my) / w;
            }
            if (pass == 0 && i == 10 && j == 10) mx /= w, my /= w;
          }
      sum += (2 * mx * my + 1e-4) * (2 * cov + 9e-4) / ((mx * mx + my * my + 1e-4) * (vx + vy + 9e-4));
      ++windows;
    }
  EXPECT_EQ(windows, 12);
  EXPECT_NEAR(structural_similarity(a, b), sum / windows, 1e-6);
}

}  // namespace
}  // namespace quincunx

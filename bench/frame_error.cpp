#include "bench/frame_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "app/render_report.h"
#include "render/color_space.h"

namespace quincunx {
namespace {

constexpr double kSheet = 0.5;  // cells beyond which a hit is on another sheet

glm::dvec3 normal_at(const Frame& frame, std::size_t p) {
  return {frame.normal[3 * p], frame.normal[3 * p + 1], frame.normal[3 * p + 2]};
}

double root_mean_square(const std::vector<float>& values) {
  double squares = 0.0;
  for (const float v : values) squares += double(v) * v;
  return std::sqrt(squares / double(values.size()));
}

double p99(const std::vector<float>& values) { return percentile({values.begin(), values.end()}, 0.99); }

glm::dvec3 on_screen(const Frame& frame, std::size_t p) {
  return srgb_from_linear(glm::clamp(glm::dvec3(frame.color[4 * p], frame.color[4 * p + 1], frame.color[4 * p + 2]), 0.0, 1.0));
}

constexpr int kWindow = 11;

/// A plane of numbers, row by row.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;
  double& at(int i, int j) { return values[std::size_t(j) * std::size_t(width) + std::size_t(i)]; }
  double at(int i, int j) const { return values[std::size_t(j) * std::size_t(width) + std::size_t(i)]; }
};

/// ITU-R BT.601 weights of R'G'B'.
Plane luma(const Frame& frame) {
  Plane plane{frame.width, frame.height, std::vector<double>(std::size_t(frame.width) * std::size_t(frame.height))};
  for (std::size_t p = 0; p < plane.values.size(); ++p) {
    plane.values[p] = glm::dot(glm::dvec3(0.299, 0.587, 0.114), on_screen(frame, p));
  }
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane r = a;
  for (std::size_t p = 0; p < r.values.size(); ++p) r.values[p] *= b.values[p];
  return r;
}

/// The weighted means over all windows inside the plane.
Plane window_means(const Plane& plane) {
  std::array<double, kWindow> weights{};
  double sum = 0.0;
  for (int n = 0; n < kWindow; ++n) sum += weights[std::size_t(n)] = std::exp(-0.5 * std::pow((n - kWindow / 2) / 1.5, 2));
  for (double& w : weights) w /= sum;
  const int width = plane.width - kWindow + 1, height = plane.height - kWindow + 1;
  Plane rows{width, plane.height, std::vector<double>(std::size_t(width) * std::size_t(plane.height))};
  for (int j = 0; j < plane.height; ++j)
    for (int i = 0; i < width; ++i)
      for (int n = 0; n < kWindow; ++n) rows.at(i, j) += weights[std::size_t(n)] * plane.at(i + n, j);
  Plane means{width, height, std::vector<double>(std::size_t(width) * std::size_t(height))};
  for (int j = 0; j < height; ++j)
    for (int n = 0; n < kWindow; ++n)
      for (int i = 0; i < width; ++i) means.at(i, j) += weights[std::size_t(n)] * rows.at(i, j + n);
  return means;
}

}  // namespace

double angle_degrees(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / glm::pi<double>();
}

void FrameComparison::add(const Frame& frame, const Frame& reference, const CellLength& cell, const Counts& counts) {
  assert(frame.depth.size() == reference.depth.size());
  for (std::size_t p = 0; p < frame.depth.size(); ++p) {
    if (counts && !counts(p)) continue;
    const double depth = frame.depth[p], expected_depth = reference.depth[p];
    const bool hit = std::isfinite(depth), expected = std::isfinite(expected_depth);
    counts_.compared += hit || expected;
    counts_.expected += expected;
    counts_.missed += expected && !hit;
    counts_.false_hits += hit && !expected;
    if (!hit || !expected) continue;
    const double error = std::abs(depth - expected_depth) / cell(p);
    if (error > kSheet) {
      ++counts_.wrong_sheet;
      continue;
    }
    depths_.push_back(float(error));
    angles_.push_back(float(angle_degrees(normal_at(frame, p), normal_at(reference, p))));
  }
}

FrameErrors FrameComparison::errors() const {
  FrameErrors errors = counts_;
  if (depths_.empty()) return errors;
  errors.depth_rms = root_mean_square(depths_);
  errors.depth_p99 = p99(depths_);
  errors.depth_max = *std::max_element(depths_.begin(), depths_.end());
  errors.normal_rms = root_mean_square(angles_);
  errors.normal_p99 = p99(angles_);
  return errors;
}

double image_rmse(const Frame& a, const Frame& b) {
  assert(a.color.size() == b.color.size());
  double squares = 0.0;
  const std::size_t pixels = a.depth.size();
  for (std::size_t p = 0; p < pixels; ++p) {
    const glm::dvec3 difference = on_screen(a, p) - on_screen(b, p);
    squares += glm::dot(difference, difference);
  }
  return std::sqrt(squares / double(3 * pixels));
}

double structural_similarity(const Frame& a, const Frame& b) {
  if (a.width < kWindow || a.height < kWindow || a.width != b.width || a.height != b.height)
    throw std::logic_error("structural similarity: pictures are too small or differ in size");
  const Plane x = luma(a), y = luma(b);
  const Plane mx = window_means(x), my = window_means(y);
  const Plane xx = window_means(product(x, x)), yy = window_means(product(y, y)), xy = window_means(product(x, y));
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  double sum = 0.0;
  for (std::size_t p = 0; p < mx.values.size(); ++p) {
    const double m = mx.values[p], n = my.values[p];
    const double vx = xx.values[p] - m * m, vy = yy.values[p] - n * n, covariance = xy.values[p] - m * n;
    sum += (2.0 * m * n + c1) * (2.0 * covariance + c2) / ((m * m + n * n + c1) * (vx + vy + c2));
  }
  return sum / double(mx.values.size());
}

}  // namespace quincunx

#include "bench/hit_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "app/render_report.h"

namespace quincunx {
namespace {

constexpr double kSheet = 0.5;  // cells beyond which a hit is on another sheet

glm::dvec3 normal_at(const Frame& frame, std::size_t p) {
  return {frame.normal[3 * p], frame.normal[3 * p + 1], frame.normal[3 * p + 2]};
}

double angle_degrees(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / glm::pi<double>();
}

}  // namespace

HitComparison::Row HitComparison::compare_row(const Truth::Rays& rays, double isovalue, const Frame& frame,
                                              const Frame& reference, int j) {
  Row row;
  for (int i = 0; i < frame.width; ++i) {
    const std::size_t p = std::size_t(j) * std::size_t(frame.width) + std::size_t(i);
    const double depth = frame.depth[p], expected_depth = reference.depth[p];
    const bool hit = std::isfinite(depth), expected = std::isfinite(expected_depth);
    row.counts.expected += expected;
    row.counts.missed += expected && !hit;
    row.counts.false_hits += hit && !expected;
    if (!hit) continue;

    const auto ray = rays.ray(i, j);
    if (!ray) continue;  // outside by rounding; counted as a false hit
    row.counts.residual_max = std::max(row.counts.residual_max, rays.residual(*ray, depth, isovalue));
    if (!expected) continue;
    const double error = std::abs(depth - expected_depth) / ray->scale;
    if (error > kSheet) {
      ++row.counts.wrong_sheet;
      continue;
    }
    row.depths.push_back(float(error));
    const double angle = angle_degrees(normal_at(frame, p), normal_at(reference, p));
    row.angle_squares += angle * angle;
  }
  return row;
}

void HitComparison::add(const Truth& truth, const Scene& scene, const Frame& frame, const Frame& reference) {
  assert(scene.isosurfaces.size() == 1 && frame.depth.size() == reference.depth.size());
  const Truth::Rays rays = truth.rays(scene);
  std::vector<Row> rows(std::size_t(frame.height));
  tbb::parallel_for(0, frame.height, [&](int j) {
    rows[std::size_t(j)] = compare_row(rays, scene.isosurfaces.front().isovalue, frame, reference, j);
  });
  for (const Row& row : rows) {  // in order: the sums are the same on any number of threads
    total_.counts.expected += row.counts.expected;
    total_.counts.missed += row.counts.missed;
    total_.counts.false_hits += row.counts.false_hits;
    total_.counts.wrong_sheet += row.counts.wrong_sheet;
    total_.counts.residual_max = std::max(total_.counts.residual_max, row.counts.residual_max);
    total_.angle_squares += row.angle_squares;
    total_.depths.insert(total_.depths.end(), row.depths.begin(), row.depths.end());
  }
}

HitErrors HitComparison::errors() const {
  HitErrors errors = total_.counts;
  if (total_.depths.empty()) return errors;
  double squares = 0.0;
  for (const float depth : total_.depths) squares += double(depth) * depth;
  const double count = double(total_.depths.size());
  errors.depth_rms = std::sqrt(squares / count);
  errors.depth_p99 = percentile({total_.depths.begin(), total_.depths.end()}, 0.99);
  errors.normal_rms = std::sqrt(total_.angle_squares / count);
  return errors;
}

}  // namespace quincunx

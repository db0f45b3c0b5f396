// A device with validation, and pictures compared pixel by pixel.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "render/device_renderer.h"
#include "tests/render/same_picture.h"
#include "tests/render/volumes.h"

namespace quincunx {

/// The device and the kernels that all tests share.
inline std::shared_ptr<KernelCache> test_kernels() {
  static const std::shared_ptr<KernelCache> kernels = [] {
    gpu::DeviceConfig config;
    config.validation = true;
    return std::make_shared<KernelCache>(gpu::open_device(config));
  }();
  return kernels;
}

/// Every test ends with the validation layer silent.
class DeviceTest : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& message : gpu::validation_messages(test_kernels()->device())) ADD_FAILURE() << message;
  }
};

/// A request with one opaque surface, seen from `azimuth` and `elevation`.
inline Renderer::Request request_for(const Volume& volume, double isovalue, int size = 64, double azimuth = 30.0, double elevation = 20.0) {
  Renderer::Request request;
  request.scene.width = request.scene.height = size;
  request.scene.isosurfaces = {{isovalue, {0.9, 0.8, 0.7}, 1.0}};
  request.scene.camera = framing_camera(volume.lattice, volume.extents, volume.world, {azimuth, elevation, 1.0}, size, size);
  return request;
}

/// Sheared and left-handed.
inline const World kMirroredWorld{.origin = {3.0, -7.0, 11.0}, .axes = glm::dmat3(1.0, 0.2, 0.0, -0.3, 0.8, 0.1, 0.0, 0.2, -1.1)};

/// The edge of a cube of the volume of a cell, world units.
inline double cell_size(const World& world) { return std::cbrt(std::abs(glm::determinant(world.axes))); }

/// How far a picture is from the reference, over the hits both have.
struct Difference {
  std::size_t hits = 0;     ///< of the reference
  std::size_t strayed = 0;  ///< missed, false, or on another sheet (half a cell away)
  double depth_rms = 0.0, depth_p99 = 0.0;  ///< cells
  double normal_rms = 0.0;                  ///< degrees
  std::size_t off_color = 0;                ///< pixels whose colour is off by more than 2e-3

  void operator+=(const Difference& d) {
    const double n = double(hits), m = double(d.hits), sum = std::max(1.0, n + m);
    depth_rms = std::sqrt((n * depth_rms * depth_rms + m * d.depth_rms * d.depth_rms) / sum);
    normal_rms = std::sqrt((n * normal_rms * normal_rms + m * d.normal_rms * d.normal_rms) / sum);
    depth_p99 = std::max(depth_p99, d.depth_p99);
    off_color += d.off_color;
    hits += d.hits;
    strayed += d.strayed;
  }
};

inline Difference compare(const Frame& frame, const Frame& truth, double cell) {
  Difference d;
  std::vector<double> errors;
  double squares = 0.0, angles = 0.0;
  for (std::size_t p = 0; p < truth.depth.size(); ++p) {
    double off = 0.0;
    for (int c = 0; c < 4; ++c) off = std::max(off, std::abs(double(frame.color[4 * p + c]) - truth.color[4 * p + c]));
    d.off_color += off > 2e-3;
    const bool hit = std::isfinite(frame.depth[p]), expected = std::isfinite(truth.depth[p]);
    d.hits += expected;
    const double error = hit && expected ? std::abs(double(frame.depth[p]) - truth.depth[p]) / cell : 0.0;
    if (hit != expected || error > 0.5) ++d.strayed;
    if (!hit || !expected || error > 0.5) continue;
    errors.push_back(error);
    squares += error * error;
    glm::dvec3 n, m;
    for (int a = 0; a < 3; ++a) n[a] = frame.normal[3 * p + a], m[a] = truth.normal[3 * p + a];
    const double angle = std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m)) * 180.0 / M_PI;
    angles += angle * angle;
  }
  if (errors.empty()) return d;
  std::sort(errors.begin(), errors.end());
  d.depth_rms = std::sqrt(squares / double(errors.size()));
  d.depth_p99 = errors[errors.size() * 99 / 100];
  d.normal_rms = std::sqrt(angles / double(errors.size()));
  return d;
}

}  // namespace quincunx

#include "render/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kDefaultFov = 30.0;
/// The part of half the image's width and height that the domain's corners may fill.
constexpr double kFill = 0.95;

double radians(double degrees) { return degrees * (M_PI / 180.0); }

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string text(const glm::dvec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

/// v / |v| without overflow or underflow of the square; 0 for 0.
glm::dvec3 unit(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0.0 ? glm::normalize(v / largest) : glm::dvec3(0.0);
}

void check_camera(const Camera& camera, int width, int height, std::string_view what) {
  for (const auto& [name, v] : {std::pair{"eye", camera.eye}, {"target", camera.target}, {"up", camera.up}})
    if (!finite(v)) throw InputError(fmt::format("{}: {} is {}; expected three finite numbers", what, name, text(v)));
  if (!finite(camera.target - camera.eye))
    throw InputError(fmt::format("{}: eye and target are too far apart", what));
  if (!(camera.fov > 0.0 && camera.fov < 180.0))
    throw InputError(fmt::format("{}: fov is {}; expected degrees between 0 and 180, both excluded", what, camera.fov));
  if (width < 1 || height < 1)
    throw InputError(fmt::format("{}: image size is {} x {}; expected at least 1 x 1", what, width, height));
}

void check_orbit(const Orbit& orbit) {
  if (!std::isfinite(orbit.azimuth))
    throw InputError(fmt::format("--azimuth: {}; expected a finite number of degrees", orbit.azimuth));
  if (!(std::abs(orbit.elevation) <= 90.0))
    throw InputError(fmt::format("--elevation: {}; expected degrees from -90 to 90", orbit.elevation));
  if (!(orbit.zoom >= 0.01 && orbit.zoom <= 1000.0))
    throw InputError(fmt::format("--zoom: {}; expected a number from 0.01 to 1000", orbit.zoom));
}

}  // namespace

CameraFrame camera_frame(const Camera& camera, int width, int height, std::string_view what) {
  check_camera(camera, width, height, what);
  const glm::dvec3 f = unit(camera.target - camera.eye);
  if (f == glm::dvec3(0.0))
    throw InputError(fmt::format("{}: eye and target are both {}; expected two places", what, text(camera.eye)));
  const glm::dvec3 side = glm::cross(f, unit(camera.up));
  if (!(glm::length(side) > 1e-9))
    throw InputError(fmt::format("{}: up is {}; expected a vector that is not parallel to the view along {}", what,
                                 text(camera.up), text(f)));
  const glm::dvec3 r = glm::normalize(side);
  const glm::dvec3 v = glm::cross(r, f);
  const double tangent = std::tan(radians(camera.fov) / 2.0);
  return {f, r * (tangent * width / height), v * tangent};
}

glm::dvec3 pixel_direction(const CameraFrame& frame, int width, int height, int i, int j) {
  const double x = 2.0 * (i + 0.5) / width - 1.0;
  const double y = 1.0 - 2.0 * (j + 0.5) / height;
  return unit(frame.forward + frame.right * x + frame.up * y);
}

Camera framing_camera(LatticeKind lattice, const Extents& extents, const World& world, const Orbit& orbit, int width,
                      int height) {
  check_orbit(orbit);
  const double a = radians(orbit.azimuth), e = radians(orbit.elevation);
  const glm::dvec3 far(domain_max(lattice, extents));
  Camera camera;
  camera.target = world.to_world(far / 2.0);
  // r x f for up = z, and its limit at elevation +-90, where z itself would be along the view.
  camera.up = {-std::sin(a) * std::sin(e), std::cos(a) * std::sin(e), std::cos(e)};
  const glm::dvec3 backward(std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e));
  camera.eye = camera.target + backward;
  camera.fov = kDefaultFov;
  const CameraFrame frame = camera_frame(camera, width, height);

  // Stand where every corner c (from the centre) fits: |c.r| <= kFill tan_x (distance + c.f), the same for v.
  const double tan_x = glm::length(frame.right), tan_y = glm::length(frame.up);
  double distance = 0.0, radius = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    const glm::dvec3 c = world.axes * (far * sign);
    const double x = std::abs(glm::dot(c, frame.right)) / (tan_x * tan_x);
    const double y = std::abs(glm::dot(c, frame.up)) / (tan_y * tan_y);
    distance = std::max(distance, std::max(x, y) / kFill - glm::dot(c, frame.forward));
    radius = std::max(radius, glm::length(c));
  }
  if (radius == 0.0) radius = glm::length(world.axes[0]);
  // A domain without thickness, seen end-on, must still lie in front of the eye.
  distance = std::max(distance, 1.01 * radius);
  camera.eye = camera.target + distance * backward;
  camera.fov = 2.0 * std::atan(std::tan(radians(kDefaultFov) / 2.0) / orbit.zoom) * (180.0 / M_PI);
  return camera;
}

}  // namespace quincunx

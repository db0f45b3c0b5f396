// The pinhole camera (README, "Conventions").
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "lattice/volume.h"

namespace quincunx {

/// Eye, target and up in world units; vertical field of view in degrees, 0 < fov < 180.
/// With f = unit(target-eye), r = unit(f x up), v = r x f, pixel (i,j) of W x H, j = 0 at the top, looks along
/// unit(f + r (2(i+.5)/W - 1) tan(fov/2) W/H + v (1 - 2(j+.5)/H) tan(fov/2)).
struct Camera {
  glm::dvec3 eye{0.0, -1.0, 0.0}, target{0.0}, up{0.0, 0.0, 1.0};
  double fov = 30.0;
};

/// f, r tan(fov/2) W/H and v tan(fov/2) of a camera.
struct CameraFrame {
  glm::dvec3 forward, right, up;
};
/// Throws InputError naming `what` where eye = target, up is parallel to the view, fov is out of range, or a number is
/// not finite.
CameraFrame camera_frame(const Camera& camera, int width, int height, std::string_view what = "camera");

/// The unit direction through pixel (i,j).
glm::dvec3 pixel_direction(const CameraFrame& frame, int width, int height, int i, int j);

/// A view of the whole volume. Azimuth in degrees about the world's z axis, 0 = looking along +y from -y, 90 = from +x;
/// elevation in degrees above the xy plane, -90..90; zoom > 1 comes nearer by narrowing the field of view.
struct Orbit {
  double azimuth = 0.0, elevation = 0.0, zoom = 1.0;
};
/// Looks at the centre of the volume's domain, world z upwards, from the nearest place at which all eight corners of
/// the domain lie within 95 % of a W x H image (at zoom 1). At elevation +-90 up is its limit. Any world is good,
/// sheared and left-handed ones too. Throws InputError naming the flag where a number of `orbit` is out of range.
Camera framing_camera(LatticeKind lattice, const Extents& extents, const World& world, const Orbit& orbit, int width,
                      int height);

/// Reads {"eye":[x,y,z],"target":[..],"up":[..],"fov":degrees}. Up and fov may be absent: those of Camera{}. Any other
/// missing key, unknown or repeated keys, other types and cameras that see nothing are errors.
/// Throws InputError naming the file and the key.
Camera read_camera(const std::string& path);

}  // namespace quincunx

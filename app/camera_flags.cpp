#include "app/camera_flags.h"

#include <fmt/format.h>

#include <limits>

#include "app/flags.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// The first flag of the way that was given, or null.
const CLI::Option* given(const CameraFlags::Way& way) {
  for (const CLI::Option* option : way) {
    if (option->count() > 0) return option;
  }
  return nullptr;
}

}  // namespace

void add_camera_flags(CLI::App& app, CameraFlags& flags) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::string group = "Camera (one way of the three; none: the volume is framed)";
  flags.by_file = {app.add_option("--camera", flags.file,
                                  "JSON file: {\"eye\":[x,y,z], \"target\":[..], \"up\":[..], \"fov\":degrees}")
                       ->type_name("C.json")};
  flags.by_orbit = {add_number(app, "--azimuth", flags.orbit.azimuth, {-inf, inf},
                               "Degrees about the world's z axis; 0 looks along +y"),
                    add_number(app, "--elevation", flags.orbit.elevation, {-90.0, 90.0}, "Degrees above the xy plane"),
                    add_number(app, "--zoom", flags.orbit.zoom, {0.0, inf, true}, "Above 1 comes nearer")};
  flags.eye = add_vector(app, "--eye", flags.placed.eye, "Where the eye is (world)");
  flags.target = add_vector(app, "--target", flags.placed.target, "What it looks at; else the volume's centre");
  flags.by_place = {flags.eye, flags.target, add_vector(app, "--up", flags.placed.up, "Upwards; else 0 0 1"),
                    add_number(app, "--fov", flags.placed.fov, {0.0, 180.0, true}, "Vertical field of view, degrees")};
  for (const auto* way : {&flags.by_file, &flags.by_orbit, &flags.by_place}) {
    for (CLI::Option* option : *way) option->group(group);
  }
}

void check_camera_flags(const CameraFlags& flags) {
  const CLI::Option* first = nullptr;
  for (const auto* way : {&flags.by_file, &flags.by_orbit, &flags.by_place}) {
    const CLI::Option* option = given(*way);
    if (option != nullptr && first != nullptr) {
      throw InputError(
          fmt::format("{} and {}: found two ways of giving the camera, expected one of --camera, "
                      "--azimuth/--elevation/--zoom, --eye/--target/--up/--fov",
                      first->get_name(), option->get_name()));
    }
    if (option != nullptr) first = option;
  }
  const CLI::Option* placed = given(flags.by_place);
  if (placed != nullptr && flags.eye->count() == 0) {
    throw InputError(fmt::format("{}: found without --eye, expected --eye x y z beside it", placed->get_name()));
  }
}

Camera make_camera(const CameraFlags& flags, const Volume& volume, int width, int height) {
  if (given(flags.by_file) != nullptr) return read_camera(flags.file);
  if (given(flags.by_place) == nullptr) {
    return framing_camera(volume.lattice, volume.extents, volume.world, flags.orbit, width, height);
  }
  Camera camera = flags.placed;
  if (flags.target->count() == 0) {
    camera.target = volume.world.to_world(0.5 * glm::dvec3(domain_max(volume.lattice, volume.extents)));
  }
  camera_frame(camera, width, height, "--eye");
  return camera;
}

}  // namespace quincunx

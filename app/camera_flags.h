// The three ways to give a camera, of which one command line takes one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "render/camera.h"

namespace quincunx {

struct CameraFlags {
  std::string file;              ///< --camera
  Orbit orbit{30.0, 10.0, 1.0};  ///< --azimuth --elevation --zoom; half from the front for a volume in patient axes
  Camera placed{.eye = {}, .target = {}, .up = {0.0, 0.0, 1.0}};  ///< --eye --target --up --fov

  /// One of the ways: its flags, of which none may stand beside another way's.
  using Way = std::vector<CLI::Option*>;
  Way by_file, by_orbit, by_place;
  CLI::Option *eye = nullptr, *target = nullptr;
};

void add_camera_flags(CLI::App& app, CameraFlags& flags);

/// Throws InputError naming both flags where two ways are mixed, or the missing one where the eye is.
void check_camera_flags(const CameraFlags& flags);

/// The camera asked for; with no flag at all the volume is framed. Without --target the eye looks at the domain's
/// centre. Throws InputError for a camera that sees nothing (eye = target, ...).
Camera make_camera(const CameraFlags& flags, const Volume& volume, int width, int height);

}  // namespace quincunx

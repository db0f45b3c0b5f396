// The flags of `quincunx render`, and the request they make.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/camera_flags.h"
#include "app/heat.h"
#include "app/progress_bar.h"
#include "app/skip_flags.h"
#include "app/volume_flags.h"
#include "app/voxel_flags.h"
#include "render/renderer.h"

namespace quincunx {

struct RenderFlags {
  const CLI::App* app = nullptr;  ///< of add_render_flags: knows which flags were given
  std::string volume;             ///< empty for particles
  std::vector<std::string> images;  ///< -o
  std::string stats;                ///< --stats, empty for none
  HeatKind heat = HeatKind::none;   ///< of every .png
  std::vector<double> isovalues, opacities;
  std::vector<glm::dvec3> colors;
  VolumeFlags look;
  bool delta_given = false;
  double step = 0.0;  ///< cells; 0: 0.25 for surfaces, 1 for volumes
  CameraFlags camera;
  std::optional<Intersect> intersect;  ///< none: what fits device and spline
  Scene scene;                    ///< all but its surfaces, camera and intersect
  bool background_given = false;  ///< a PNG then hides what is behind it; else it lets it through
  SkipFlags skip;
  VoxelFlags voxel;
  Renderer::Config config;
  std::string scratch;  ///< folder for unpacked samples of a pool
  std::string device;
  int repeat = 1;
  bool explain = false, json = false;
  Verbosity verbosity = Verbosity::normal;

  /// Whether there is anything to trace for: --explain alone needs no picture.
  bool renders() const { return !images.empty() || !stats.empty() || (json && !explain); }
};

/// Whether write_image makes an OpenEXR file of `path`: the extension decides, whatever its case.
bool is_exr(const std::string& path);

void add_render_flags(CLI::App& app, RenderFlags& flags);

/// Those of them that other commands have too: "--iso", several values; "--intersect" and "--step"; "--precision".
CLI::Option* add_isovalues(CLI::App& app, RenderFlags& flags);
CLI::Option* add_intersect(CLI::App& app, RenderFlags& flags);
CLI::Option* add_step(CLI::App& app, RenderFlags& flags);
CLI::Option* add_precision(CLI::App& app, RenderFlags& flags);

/// Throws InputError where nothing is to be seen: neither an isovalue nor a transfer function.
void check_something_is_seen(const RenderFlags& flags);

/// Throws InputError naming the flag for what can be seen to be wrong before any work: no or equal isovalues, lists of
/// unequal length, two cameras, nothing to make, a place that cannot be written.
void check_render_flags(const RenderFlags& flags);

/// The isosurfaces asked for, with colours and opacities of a palette where none is given: several surfaces let the
/// eye through to the one of the highest isovalue.
std::vector<Isosurface> make_isosurfaces(const RenderFlags& flags);

/// What is to be seen: all of the scene but its camera. Reads the transfer function. Throws InputError naming the file or flag. Says so (a note on stderr)
/// where surfaces are marched although nobody asked for it.
Scene make_scene(const RenderFlags& flags);

/// The request for `volume`. Throws InputError naming the flag.
Renderer::Request make_request(const RenderFlags& flags, const Volume& volume);

}  // namespace quincunx

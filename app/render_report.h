// What `quincunx render` tells about a frame, and the frame as an image.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/image_file.h"
#include "render/renderer.h"

namespace quincunx {

/// The frame's planes as channels R G B A Z N.X N.Y N.Z [cost.evaluations cost.steps cost.intervals].
Image to_image(const Frame& frame);

/// The frame over its background as channels R G B: nothing behind it shows through.
Image to_opaque_image(const Frame& frame);

/// The value below which `fraction` (0..1) of the values lie, between two by linear interpolation; values not empty.
double percentile(std::vector<double> values, double fraction);

/// How a volume is looked at: `transfer_function` of the keys of --stats.
nlohmann::ordered_json volume_json(const DirectVolume& volume);

/// The statistics of a render; README, "Statistics", names the keys.
nlohmann::ordered_json stats_json(const std::string& volume, const Renderer::Request& request, const RenderStats& stats,
                                  double read_ms);

/// Milliseconds before the renderer's own.
struct VoxelTimes {
  double read = 0.0, resample = 0.0, voxels = 0.0;
};
/// The same of a picture of voxels, `subject` the file they are of: README, "Voxels".
nlohmann::ordered_json voxels_json(const std::string& subject, const Renderer::Request& request, const RenderStats& stats, const VoxelTimes& times);

nlohmann::ordered_json explain_json(const std::vector<Feature>& features);
/// The features as a table: compiled in first, then left out.
std::string explain_text(const std::vector<Feature>& features);

}  // namespace quincunx

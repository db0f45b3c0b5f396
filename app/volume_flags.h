// The flags of direct volume rendering.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "render/scene.h"

namespace quincunx {

struct VolumeFlags {
  std::string transfer_function;  ///< --tf, a file; empty: no volume is shown
  DirectVolume look;              ///< all but its function and step
  std::string first_given;        ///< a flag that only means something with --tf; empty where none stood
};

void add_volume_flags(CLI::App& app, VolumeFlags& flags);

/// Throws InputError where a flag was given that --tf has to come with.
void check_volume_flags(const VolumeFlags& flags);

/// What is to be seen of the volume, its function read; nothing without --tf. `step` in cells. Throws InputError naming the file or flag.
std::optional<DirectVolume> make_direct_volume(const VolumeFlags& flags, double step);

}  // namespace quincunx

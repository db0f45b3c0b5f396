// quincunx sweep --preset: the experiments of publications.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/progress_bar.h"
#include "bench/preset_run.h"

namespace quincunx {

struct PresetFlags {
  std::string name;  ///< of presets(); empty: no preset
  bool full = false, list = false;
};

/// "--preset", "--full" and "--list-presets".
void add_preset_flags(CLI::App& app, PresetFlags& flags);

/// Throws InputError where `app` was given a flag that belongs to presets alone without one, or one that the preset fixes: any but VOLUME, --iso,
/// --spline, --device, --json, -o and --quiet.
void check_preset_flags(const CLI::App& app, const PresetFlags& flags);

/// Prints a line for each preset.
void list_presets();

/// Measures the preset into `folder`: NAME.csv, NAME.json, NAME.md, and NAME.svg where the publication has a drawing. Prints the table, or its JSON. After Ctrl-C,
/// writes what was measured and throws Interrupted. Throws std::runtime_error where pictures differ.
void sweep_preset(const PresetFlags& flags, const PresetWishes& wishes, const std::string& folder, bool json, Verbosity verbosity);

}  // namespace quincunx

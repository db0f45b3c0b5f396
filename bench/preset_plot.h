// The drawing of a preset.
#pragma once

#include <string>

#include "bench/preset_report.h"

namespace quincunx {

/// A script for gnuplot that writes SVG to standard output: the report's panels, at least one, side by side.
std::string preset_plot_script(const PresetReport& report);

}  // namespace quincunx

// The drawing of a sweep.
#pragma once

#include <string>

#include "bench/sweep_report.h"

namespace quincunx {

/// A script for gnuplot that writes SVG to standard output: median frame time against block size on logarithmic axes, one line a structure,
/// `none` as a horizontal line, the best setting and what auto chose marked.
std::string sweep_plot_script(const SweepReport& report);

}  // namespace quincunx

// Error against time, drawn.
#pragma once

#include <string>

#include "bench/compare_report.h"

namespace quincunx {

/// A script for gnuplot that draws the report's metric against the median frame as SVG: a colour for each spline, a shape for each way to the hit,
/// and the Pareto front as a line. Both axes are logarithmic; errors of 0 stand on the lower edge.
std::string compare_plot_script(const CompareReport& report);

}  // namespace quincunx

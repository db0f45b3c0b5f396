#include "bench/compare_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bench/gnuplot.h"

namespace quincunx {
namespace {

/// Colours that colour-blind eyes tell apart (M. Okabe, K. Ito), and two more.
constexpr std::array<const char*, 10> kSplineColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f5a3c", "#808080", "#000000", "#9467bd"};
/// Exact a disc; marches by the order of their steps.
constexpr std::array<int, 5> kMethodShapes{7, 8, 10, 4, 12};

/// Errors that are shown: those of 0 as `least`.
struct ErrorScale {
  double least = 1.0, largest = 1.0;
};

ErrorScale error_scale(const CompareReport& report) {
  double least = 0.0, largest = 0.0;
  bool zero = false;
  for (const CompareLine& line : report.measured.lines) {
    const double error = report.metric->value(line).value();
    zero = zero || error == 0.0;
    if (error > 0.0) least = least > 0.0 ? std::min(least, error) : error;
    largest = std::max(largest, error);
  }
  if (largest == 0.0) return {};
  return {zero ? least / 3.0 : least, largest};
}

/// A logarithmic axis with some room at both ends.
std::string axis(char name, double least, double largest) {
  const double low = least / 1.15, high = largest * 1.15;
  return fmt::format("set {0}range [{1}:{2}]\nset {0}tics nomirror ({3})\n", name, low, high, gnuplot_marks(low, high));
}

/// Points of one look.
struct PointGroup {
  std::string spline, method, points;
};

}  // namespace

std::string compare_plot_script(const CompareReport& report) {
  const std::vector<CompareLine>& lines = report.measured.lines;
  const ErrorScale scale = error_scale(report);
  const auto point = [&](const CompareLine& line) { return fmt::format("{} {}\n", median_ms(line), std::max(report.metric->value(line).value(), scale.least)); };

  std::vector<std::string> splines, methods{"exact"};
  std::vector<PointGroup> groups;
  for (const CompareLine& line : lines) {
    const std::string spline = line.setting.spline + (report.subject->volumes[line.setting.volume].name.ends_with("sparse") ? " sparse" : "");
    place_of(splines, spline), place_of(methods, line.setting.method());
    const auto same = [&](const PointGroup& g) { return g.spline == spline && g.method == line.setting.method(); };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(groups.end(), {spline, line.setting.method(), ""});
    group->points += point(line);
  }

  const std::size_t height = std::max<std::size_t>(560, 140 + 20 * (groups.size() + 1));
  std::string text = fmt::format("set terminal svg size 960,{} background 'white' font 'DejaVu Sans,13'\n", height);
  text += fmt::format("set title {}.\"\\n\".{} noenhanced\n", gnuplot_string(compare_caption(report)), gnuplot_string(report.machine.device));
  text += "set key outside right top maxcols 1 reverse Left noenhanced samplen 1\n";
  double fastest = median_ms(lines.front()), slowest = fastest;
  for (const CompareLine& line : lines) fastest = std::min(fastest, median_ms(line)), slowest = std::max(slowest, median_ms(line));
  text += "set logscale xy\nset grid back lc rgb '#d0d0d0' dt 1 lw 0.5\nset border 3\n";
  text += fmt::format("set xlabel 'frame, ms (median)'\nset ylabel {} noenhanced\n", gnuplot_string(std::string(report.metric->title)));
  text += axis('x', fastest, slowest) + axis('y', scale.least, scale.largest);
  std::string data = "$front << EOD\n";
  for (const std::size_t n : pareto_front(lines, *report.metric)) data += point(lines[n]);
  data += "EOD\n";
  std::vector<std::string> plots{"$front with lines lw 2 dt 2 lc rgb '#606060' title 'Pareto front'"};
  for (const PointGroup& group : groups) {
    const std::string name = fmt::format("$data{}", plots.size());
    data += fmt::format("{} << EOD\n{}EOD\n", name, group.points);
    plots.push_back(fmt::format("{} with points pt {} ps 1.1 lw 1.6 lc rgb '{}' title {}", name, kMethodShapes[place_of(methods, group.method) % kMethodShapes.size()],
                                kSplineColors[place_of(splines, group.spline) % kSplineColors.size()], gnuplot_string(group.spline + ", " + group.method)));
  }
  return text + data + fmt::format("plot {}\n", fmt::join(plots, ", \\\n     "));
}

}  // namespace quincunx

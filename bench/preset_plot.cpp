#include "bench/preset_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "bench/gnuplot.h"
#include "bench/presets.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

/// Colours that colour-blind eyes tell apart (M. Okabe, K. Ito).
constexpr std::array<const char*, 12> kSeriesColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f5a3c", "#808080", "#000000", "#882255", "#44aa99", "#999933"};
constexpr std::array<int, 8> kSeriesShapes{7, 5, 9, 11, 13, 6, 4, 8};

/// Rows that a panel shows: what it is drawn of is there.
std::vector<const std::vector<Json>*> shown_rows(const PresetReport& report, const PresetPanel& panel) {
  std::vector<const std::vector<Json>*> rows;
  for (const auto& row : report.rows) {
    const bool here = panel.where.empty() || row[report.column(panel.where)] == panel.where_is;
    if (here && row[report.column(panel.y)].is_number() && !row[report.column(panel.x)].is_null()) rows.push_back(&row);
  }
  return rows;
}

/// One panel: axes, then data blocks whose names begin with `prefix`, then the plot.
std::string panel_script(const PresetReport& report, const PresetPanel& panel, const std::string& prefix) {
  const auto rows = shown_rows(report, panel);
  if (rows.empty()) return "";
  const std::size_t x = report.column(panel.x), s = report.column(panel.series), y = report.column(panel.y);
  const bool bars = (*rows.front())[x].is_string(), whiskers = !panel.low.empty();
  std::vector<std::string> groups, series;
  for (const auto* row : rows) {
    place_of(series, (*row)[s].get<std::string>());
    if (bars) place_of(groups, (*row)[x].get<std::string>());
  }
  const double width = 0.85 / double(series.size());
  std::vector<std::string> points(series.size());
  for (const auto* row : rows) {
    const std::size_t n = place_of(series, (*row)[s].get<std::string>());
    const double value = (*row)[y].get<double>();
    const double at = bars ? double(place_of(groups, (*row)[x].get<std::string>())) + (double(n) - 0.5 * double(series.size() - 1)) * width : (*row)[x].get<double>();
    points[n] += fmt::format("{} {} {} {}\n", at, value, whiskers ? (*row)[report.column(panel.low)].get<double>() : value,
                             whiskers ? (*row)[report.column(panel.high)].get<double>() : value);
  }
  std::string text = fmt::format("set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n", gnuplot_string(panel.title), gnuplot_string(panel.x_label),
                                 gnuplot_string(panel.y_label));
  text += panel.y_logarithmic ? "set logscale y\nset yrange [*:*]\n" : "unset logscale y\nset yrange [0:*]\n";
  if (bars) {
    std::vector<std::string> marks;
    for (std::size_t n = 0; n < groups.size(); ++n) marks.push_back(fmt::format("{} {}", gnuplot_string(groups[n]), n));
    text += fmt::format("set xrange [-0.6:{}]\nset xtics nomirror noenhanced ({})\nset boxwidth {}\nset style fill solid 0.85\n", double(groups.size()) - 0.4, fmt::join(marks, ", "), width);
  } else {
    text += "set xrange [*:*]\nset xtics nomirror autofreq\n";
  }
  std::vector<std::string> everywhere;  // a series looks the same in every panel
  for (const auto& row : report.rows)
    if (row[s].is_string()) place_of(everywhere, row[s].get<std::string>());
  std::vector<std::string> plots;
  for (std::size_t n = 0; n < series.size(); ++n) {
    text += fmt::format("${}{} << EOD\n{}EOD\n", prefix, n, points[n]);
    const std::size_t look = place_of(everywhere, series[n]);
    const char* color = kSeriesColors[look % kSeriesColors.size()];
    plots.push_back(bars ? fmt::format("${}{} using 1:2 with boxes lc rgb '{}' title {}", prefix, n, color, gnuplot_string(series[n]))
                         : fmt::format("${}{} using 1:2 with linespoints lw 2 pt {} ps 0.8 lc rgb '{}' title {}", prefix, n, kSeriesShapes[look % kSeriesShapes.size()], color, gnuplot_string(series[n])));
    if (whiskers) plots.push_back(fmt::format("${}{} using 1:2:3:4 with yerrorbars ps 0 lc rgb '#303030' notitle", prefix, n));
  }
  return text + fmt::format("plot {}\n", fmt::join(plots, ", \\\n     "));
}

}  // namespace

std::string preset_plot_script(const PresetReport& report) {
  assert(!report.panels.empty());
  const std::size_t count = report.panels.size();
  std::string text = fmt::format("set terminal svg size {},{} background 'white' font 'DejaVu Sans,12'\n", 560 * std::min<std::size_t>(count, 2) + 160, 480 * ((count + 1) / 2));
  text += "set key outside right top maxcols 1 reverse Left noenhanced samplen 1\nset grid ytics back lc rgb '#d0d0d0' dt 1 lw 0.5\nset border 3\nset ytics nomirror\n";
  text += fmt::format("set multiplot layout {},{} title {} noenhanced\n", (count + 1) / 2, std::min<std::size_t>(count, 2),
                      gnuplot_string(fmt::format("{}, {}", report.preset->name, report.machine.device.empty() ? report.machine.processor : report.machine.device)));
  for (std::size_t n = 0; n < count; ++n) text += panel_script(report, report.panels[n], fmt::format("panel{}_", n));
  return text + "unset multiplot\n";
}

}  // namespace quincunx

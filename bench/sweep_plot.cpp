#include "bench/sweep_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "accel/structure.h"
#include "app/render_report.h"
#include "bench/gnuplot.h"

namespace quincunx {
namespace {

/// A line of the drawing: a structure with or without cell tests, and what is drawn for it.
struct Curve {
  std::string title, style, points;
};

/// Colours that colour-blind eyes tell apart (M. Okabe, K. Ito), with a shape of their own, by the place in skip_labels().
constexpr std::array<const char*, 12> kLabelColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                              "#7f5a3c", "#808080", "#f0e442", "#000000", "#332288", "#aa1144"};
constexpr std::array<int, 12> kLabelShapes{7, 5, 9, 11, 13, 6, 4, 8, 10, 12, 15, 14};

std::string point(const SweepReport& report, std::size_t n) {
  return fmt::format("{} {}\n", report.settings[n].skip.block, report.median_ms(n));
}

std::vector<Curve> curves(const SweepReport& report) {
  const auto& labels = skip_labels();
  std::vector<Curve> all;
  for (const bool cell_test : {true, false}) {
    for (std::size_t place = 0; place < labels.size(); ++place) {
      Curve curve;
      for (std::size_t n = 1; n < report.measured.size(); ++n) {
        const SweepSetting& setting = report.settings[n];
        if (setting.label() == labels[place] && setting.skip.cell_test == cell_test) curve.points += point(report, n);
      }
      if (curve.points.empty()) continue;
      curve.title = fmt::format("{}{}", labels[place], cell_test ? "" : ", no cell test");
      const std::size_t look = (place + kLabelColors.size() - 1) % kLabelColors.size();  // none is the first label
      curve.style = fmt::format("with linespoints lw 2 dt {} pt {} ps 0.8 lc rgb '{}'", cell_test ? 1 : 2, kLabelShapes[look], kLabelColors[look]);
      all.push_back(std::move(curve));
    }
  }
  return all;
}

/// Title, axes, legend.
std::string frame_of_the_drawing(const SweepReport& report, std::size_t curve_count) {
  double low = report.median_ms(0), high = low;
  std::set<int> blocks;
  for (std::size_t n = 0; n < report.measured.size(); ++n) {
    low = std::min(low, report.median_ms(n));
    high = std::max(high, report.median_ms(n));
    if (report.settings[n].skips()) blocks.insert(report.settings[n].skip.block);
  }
  low = std::max(low / 1.25, 1e-6);
  high = std::max(high * 1.25, 2.0 * low);
  if (blocks.empty()) blocks.insert(1);
  std::vector<std::string> block_marks;
  for (const int block : blocks) block_marks.push_back(fmt::format("'{0}' {0}", block));

  const std::string title =
      fmt::format("{}, {}, {} x {}, {}", std::filesystem::path(report.volume).filename().string(), sweep_subject(report), report.width,
                  report.height, sweep_method(report));
  const std::size_t height = std::max<std::size_t>(560, 150 + 22 * (curve_count + 3));  // none, the best and auto are in the legend too
  std::string text = fmt::format("set terminal svg size 960,{} background 'white' font 'DejaVu Sans,13'\n", height);
  text += fmt::format("set title {}.\"\\n\".{} noenhanced\n", gnuplot_string(title), gnuplot_string(report.machine.device));
  text += "set key outside right top maxcols 1 reverse Left noenhanced samplen 2\n";
  text += "set logscale x 2\nset logscale y 10\nset grid back lc rgb '#d0d0d0' dt 1 lw 0.5\nset border 3\n";
  text += "set xlabel 'edge of a block, cells'\nset ylabel 'frame, ms (median)'\n";
  text += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", *blocks.begin() / 1.25, *blocks.rbegin() * 1.25, low, high);
  text += fmt::format("set xtics nomirror ({})\nset ytics nomirror ({})\n", fmt::join(block_marks, ", "), gnuplot_marks(low, high));
  return text;
}

}  // namespace

std::string sweep_plot_script(const SweepReport& report) {
  const std::vector<Curve> structures = curves(report);
  std::string text = frame_of_the_drawing(report, structures.size()), data;
  std::vector<std::string> plots{
      fmt::format("{} with lines lw 2 dt 3 lc rgb '#000000' title 'none'", report.median_ms(0))};
  const auto add = [&](const std::string& points, const std::string& style, const std::string& title) {
    const std::string name = fmt::format("$data{}", plots.size());
    data += fmt::format("{} << EOD\n{}EOD\n", name, points);
    plots.push_back(fmt::format("{} {} title {}", name, style, gnuplot_string(title)));
  };
  for (const Curve& curve : structures) add(curve.points, curve.style, curve.title);
  // None has no block to be marked at.
  const std::size_t best = report.best();
  if (report.settings[best].skips()) add(point(report, best), "with points pt 6 ps 2.2 lw 2 lc rgb '#000000'", "the best");
  for (std::size_t n = 0; n < report.measured.size(); ++n) {
    if (report.settings[n].chosen && report.settings[n].skips())
      add(point(report, n), "with points pt 4 ps 2.8 lw 2 lc rgb '#c00000'", "chosen by auto");
  }
  return text + data + fmt::format("plot {}\n", fmt::join(plots, ", \\\n     "));
}

}  // namespace quincunx

// S. Zellmann, "Comparing Hierarchical Data Structures for Sparse Volume Rendering with Empty Space Skipping", technical report, 2019,
// doi:10.36227/techrxiv.11416422, and S. Zellmann, D. Meurer, U. Lang, "Hybrid Grids for Sparse Volume Rendering", IEEE VIS 2019,
// doi:10.1109/VISUAL.2019.8933631: Table 1 and Figures 3 to 5 on other data, with the structures of both.
// Generated volumes stand for the data sets.
#include <algorithm>
#include <utility>

#include "app/render_report.h"
#include "bench/presets.h"
#include "bench/timing.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> structures(PresetRun& run) {
  return run.known({"grid", "kdtree:shallow", "kdtree:deep", "bvh", "hybrid:mm", "hybrid:pc"});
}

double median_ms(const SweepMeasurement& m) { return percentile(m.cost.frame_ms, 0.5); }

/// What a structure has to do for a new transfer function, but for the upload.
Json construction_ms(const SweepSetting& setting, const SweepMeasurement& m) {
  return setting.skips() ? Json(m.stages.classify_ms + m.stages.cluster_ms + m.stages.build_ms) : Json(nullptr);
}

Json active_percent(const SweepSetting& setting, const SweepMeasurement& m) {
  return setting.skips() ? Json(100.0 * double(m.scene.active_blocks) / double(m.scene.blocks)) : Json(nullptr);
}

Json structure_bytes(const SweepSetting& setting, const SweepMeasurement& m) {
  for (const auto& [purpose, bytes] : m.scene.device_bytes)
    if (purpose == "structure" && setting.skips()) return bytes;
  return nullptr;
}

/// The samples that may be seen.
double non_empty_percent(const PresetVolume& data) {
  return std::visit(
      [&](const auto& samples) {
        const auto seen = std::count_if(samples.begin(), samples.end(), [&](auto sample) { return double(sample) >= data.threshold; });
        return 100.0 * double(seen) / double(samples.size());
      },
      data.volume.samples);
}

/// Opacity wherever there is a value: nothing to be skipped, and rays go far.
DirectVolume everywhere(const PresetVolume& data) {
  DirectVolume look = preset_look(data, 0.0);
  for (auto& point : look.function.opacities) point.opacity = 0.01;
  return look;
}

/// Balls, and which of the figure's two parts they are of.
struct Balls {
  std::string part;
  int count;
  double radius;  ///< cells
};

std::vector<Balls> figure5_balls(int cells) {
  std::vector<Balls> all;
  for (const int n : {1, 2, 3, 4, 6}) all.push_back({"growing", 8, n * cells / 32.0});
  for (const int count : {1, 4, 16, 64}) all.push_back({"more", count, cells / 16.0});
  return all;
}

}  // namespace

void zellmann_table1(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "structure", "size", "non_empty_percent", "active_percent", "construction_ms", "bytes", "frames_per_second", "published"};
  report.left = 3;
  report.notes = {"Non-empty: of the samples; active: of the blocks. Construction: classification, clusters and structure, on the CPU."};
  const auto labels = structures(run);
  for (const PresetSource& source : run.sources({"strands", "solid parts", "vessels", "points"}, run.size().cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    const double non_empty = non_empty_percent(data);
    run.sweep(*run.renderer(data), data, preset_look(data, 0.1), labels, [&](const SweepSetting& setting, const SweepMeasurement& m, const SweepMeasurement&) {
      report.rows.push_back({source.name, setting.label(), preset_extents(data.volume), non_empty, active_percent(setting, m), construction_ms(setting, m), structure_bytes(setting, m),
                             1000.0 / median_ms(m), nullptr});
    });
  }
}

void zellmann_figure3(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "structure", "active_percent", "frame_ms", "frames_per_second", "speedup", "published"};
  report.left = 2;
  report.panels = {{.title = "frame rates", .x = "data_set", .series = "structure", .y = "frames_per_second", .y_label = "frames per second (median)"}};
  report.notes = {"Speed-up over none."};
  const auto labels = structures(run);
  for (const PresetSource& source : run.sources({"strands", "solid parts", "vessels", "points"}, run.size().cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    run.sweep(*run.renderer(data), data, preset_look(data, 0.1), labels, [&](const SweepSetting& setting, const SweepMeasurement& m, const SweepMeasurement& none) {
      report.rows.push_back({source.name, setting.label(), active_percent(setting, m), median_ms(m), 1000.0 / median_ms(m), speedup(m.cost, none.cost).median, nullptr});
    });
  }
}

void zellmann_figure4(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "structure", "active_percent", "construction_ms", "frame_ms", "overhead_percent", "published"};
  report.left = 2;
  report.panels = {{.title = "nothing is empty", .x = "data_set", .series = "structure", .y = "frame_ms", .y_label = "frame, ms (median)"}};
  report.notes = {"Every value has opacity; the overhead over none."};
  const auto labels = structures(run);
  for (const PresetSource& source : run.sources({"waves"}, run.size().cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    run.sweep(*run.renderer(data), data, everywhere(data), labels, [&](const SweepSetting& setting, const SweepMeasurement& m, const SweepMeasurement& none) {
      report.rows.push_back({source.name, setting.label(), active_percent(setting, m), construction_ms(setting, m), median_ms(m), 100.0 * (speedup(none.cost, m.cost).median - 1.0), nullptr});
    });
  }
}

void zellmann_figure5(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"part", "structure", "clusters", "radius", "active_percent", "construction_ms", "frame_ms", "published"};
  report.left = 2;
  for (const auto& [part, x, x_label] : {std::tuple("growing", "radius", "radius of 8 clusters, cells"), std::tuple("more", "clusters", "clusters of one size")})
    for (const auto& [y, y_label] : {std::pair("frame_ms", "frame, ms (median)"), std::pair("construction_ms", "construction, ms")})
      report.panels.push_back({.title = part, .x = x, .series = "structure", .y = y, .where = "part", .where_is = part, .x_label = x_label, .y_label = y_label});
  report.notes = {"Balls about the same middles; radii in cells."};
  const auto labels = structures(run);
  for (const Balls& balls : figure5_balls(run.size().cells)) {
    const PresetVolume data = run.balls(balls.count, balls.radius);
    run.sweep(*run.renderer(data), data, preset_look(data, 0.1), labels, [&](const SweepSetting& setting, const SweepMeasurement& m, const SweepMeasurement&) {
      report.rows.push_back({balls.part, setting.label(), balls.count, balls.radius, active_percent(setting, m), construction_ms(setting, m), median_ms(m), nullptr});
    });
  }
}

}  // namespace quincunx

// D. Ganter, M. Manzke, "An analysis of region clustered BVH volume rendering on GPU", Computer Graphics Forum 38(8), 2019,
// doi:10.1111/cgf.13756: its Table 1 and Figures 6, 7, 8 and 10 on other data, and clustering to boxes beside theirs to cubes. Its data sets
// are not public; generated ones stand for them.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "app/render_report.h"
#include "bench/cluster_measure.h"
#include "bench/presets.h"
#include "bench/timing.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxCluster = 16;  ///< edge of the largest cube in blocks
constexpr double kMost = std::numeric_limits<double>::max();

double percent(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }
double median(const std::vector<double>& values) { return percentile(values, 0.5); }

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

std::string rounds_text(const PresetSize& size) { return fmt::format("Medians of {} round{} in turns.", size.cluster_rounds, size.cluster_rounds == 1 ? "" : "s"); }

/// Calls row(clusters, cost) for single blocks, cubes and boxes.
void for_each_clustering(const ClusterLine& line, const auto& row) {
  row("none", line.single);
  row("cubes", line.cubes);
  row("boxes", line.boxes);
}

/// "38-53" where the paper tells that of cubes of such data.
Json published_leaves(const std::string& data_set, const std::string& clusters) {
  if (clusters != "cubes") return nullptr;
  return data_set == "strands" ? Json("38-53") : data_set == "solid parts" ? Json("5-35") : Json(nullptr);
}

/// By how much the frame rate is higher than that of `baseline`, where there is one.
Json faster_percent(const Cost& cost, const std::optional<Cost>& baseline) {
  return baseline ? Json(100.0 * (speedup(cost, *baseline).median - 1.0)) : Json(nullptr);
}

/// The value from which on as many blocks are active as make `part` of them; more where the last of these share a bound.
double threshold_of_part(const BlockBounds& blocks, const ValueScale& scale, double part) {
  std::vector<std::uint16_t> most = blocks.max;
  const std::size_t count = std::clamp<std::size_t>(std::size_t(part * double(most.size()) + 0.5), 1, most.size());
  std::nth_element(most.begin(), most.begin() + std::ptrdiff_t(count - 1), most.end(), std::greater<>());
  return scale.value(most[count - 1]);
}

}  // namespace

void ganter_table1(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "clusters", "block", "blocks", "active", "active_percent", "leaves", "leaves_percent", "cluster_ms", "bvh_ms", "published_leaves_percent"};
  report.left = 2;
  report.setup = rounds_text(run.size());
  for (const PresetSource& source : run.sources({"strands", "solid parts", "vessels"}, run.size().cluster_cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    const CellBounds cells = run.bounds(data);
    const ValueRange seen{data.threshold, kMost};
    const Progress progress = run.bar().stage(source.name + ", clusters");
    for (const int block : run.size().cluster_blocks) {
      quincunx::report(progress, double(block) / double(2 * run.size().cluster_blocks.back()));
      const Classification blocks = classify(block_bounds(cells, block), cells, {&seen, 1});
      const ClusterLine line = measure_clusters(source.name, blocks, kMaxCluster, run.size().cluster_rounds);
      for_each_clustering(line, [&](const std::string& clusters, const ClusterCost& cost) {
        report.rows.push_back({source.name, clusters, block, blocks.level.size(), line.active, percent(double(line.active), double(blocks.level.size())), cost.leaves,
                               100.0 * line.part(cost), median(cost.cluster_ms), median(cost.build_ms), published_leaves(source.name, clusters)});
      });
    }
  }
}

void ganter_figure6(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "structure", "active_percent", "leaves", "frame_ms", "least_ms", "most_ms", "faster_percent", "published_percent"};
  report.left = 2;
  report.panels = {{.title = "with and without clustering", .x = "data_set", .series = "structure", .y = "frame_ms", .low = "least_ms", .high = "most_ms", .y_label = "frame, ms (mean, range)"}};
  report.notes = {"Means over the orbit; by how much the frame rate is higher than that of single blocks."};
  const auto labels = run.known({"bvh", "bvh:cubes", "bvh:boxes"});
  for (const PresetSource& source : run.sources({"strands", "solid parts", "vessels"}, run.size().cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    std::optional<Cost> single;
    run.sweep(*run.renderer(data), data, preset_look(data, 0.3), labels, [&](const SweepSetting& setting, const SweepMeasurement& m, const SweepMeasurement&) {
      if (!setting.skips()) return;
      if (setting.label() == "bvh") single = m.cost;
      const auto& ms = m.cost.frame_ms;
      report.rows.push_back({source.name, setting.label(), percent(double(m.scene.active_blocks), double(m.scene.blocks)), m.scene.leaves, mean(ms), percentile(ms, 0.0), percentile(ms, 1.0),
                             faster_percent(m.cost, single), setting.label() == "bvh:cubes" ? Json("10-15") : Json(nullptr)});
    });
  }
}

void ganter_figure7(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "clusters", "active_percent", "blocks", "active", "leaves", "cluster_ms", "bvh_ms", "sum_ms", "published"};
  report.left = 2;
  report.setup = rounds_text(run.size());
  for (const auto& source : run.sources({"waves"}, run.size().cluster_cells)) {
    report.panels.push_back({.title = source.name, .x = "active_percent", .series = "clusters", .y = "sum_ms", .where = "data_set", .where_is = source.name, .x_label = "active blocks, %",
                             .y_label = "clusters and hierarchy, ms"});
    const PresetVolume data = source.make(run.bar().stage(source.name));
    const CellBounds cells = run.bounds(data);
    const BlockBounds bounds = block_bounds(cells, run.size().cluster_blocks.front());
    const Progress progress = run.bar().stage(source.name + ", clusters");
    for (const double part : {0.08, 0.2, 0.4, 0.6, 0.8, 1.0}) {
      quincunx::report(progress, part / 2.0);
      const ValueRange seen{threshold_of_part(bounds, cells, part), kMost};
      const Classification blocks = classify(bounds, cells, {&seen, 1});
      const ClusterLine line = measure_clusters(source.name, blocks, kMaxCluster, run.size().cluster_rounds);
      for_each_clustering(line, [&](const std::string& clusters, const ClusterCost& cost) {
        const double cluster = median(cost.cluster_ms), build = median(cost.build_ms);
        report.rows.push_back({source.name, clusters, percent(double(line.active), double(blocks.level.size())), blocks.level.size(), line.active, cost.leaves, cluster, build, cluster + build, nullptr});
      });
    }
  }
}

void ganter_figure8(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "structure", "intervals_per_ray", "traversal_ms", "least_ms", "most_ms", "range_percent", "faster_than_segments_percent", "published_percent"};
  report.left = 2;
  report.panels = {{.title = "traversal alone", .x = "data_set", .series = "structure", .y = "traversal_ms", .low = "least_ms", .high = "most_ms", .y_label = "all rays to their end, ms (median, range)"}};
  report.notes = {"Medians over the orbit; the range in % of the median."};
  const auto labels = run.known({"segments", "bvh", "bvh:cubes", "bvh:boxes", "octree", "grid"});  // segments first: others are told against it
  for (const PresetSource& source : run.sources({"strands", "solid parts", "vessels"}, run.size().cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    std::optional<Cost> segments;
    run.sweep(*run.renderer(data), data, preset_look(data, 0.3), labels, [&](const SweepSetting& setting, const SweepMeasurement& m, const SweepMeasurement&) {
      if (!setting.skips()) return;
      Cost walks;
      walks.frame_ms = m.traversal_ms;
      if (setting.label() == "segments") segments = walks;
      const double middle = median(m.traversal_ms), least = percentile(m.traversal_ms, 0.0), most = percentile(m.traversal_ms, 1.0);
      report.rows.push_back({source.name, setting.label(), double(m.traversal_intervals) / double(m.cost.rays), middle, least, most, percent(most - least, middle), faster_percent(walks, segments),
                             setting.label() == "bvh:cubes" ? Json("20-40") : Json(nullptr)});
    });
  }
}

void ganter_figure10(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "function", "structure", "active", "frame_ms", "least_ms", "most_ms", "speedup", "published"};
  report.left = 3;
  for (const std::string function : {"opaque", "clear"})
    report.panels.push_back({.title = function, .x = "data_set", .series = "structure", .y = "frame_ms", .low = "least_ms", .high = "most_ms",
                             .where = "function", .where_is = function, .y_label = "frame, ms (mean, range)"});
  report.notes = {"Means over the orbit; speed-up over none."};
  const auto labels = run.known({"bvh", "bvh:cubes", "bvh:boxes", "segments", "octree", "distance", "grid"});
  for (const PresetSource& source : run.sources({"strands", "vessels"}, run.size().cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    const auto renderer = run.renderer(data);
    for (const auto& [function, opacity] : {std::pair("opaque", 0.95), std::pair("clear", 0.02)}) {
      run.sweep(*renderer, data, preset_look(data, opacity), labels, [&, function = function](const SweepSetting& setting, const SweepMeasurement& m, const SweepMeasurement& none) {
        const auto& ms = m.cost.frame_ms;
        report.rows.push_back({source.name, function, setting.label(), setting.skips() ? Json(m.scene.active_blocks) : Json(nullptr), mean(ms), percentile(ms, 0.0), percentile(ms, 1.0),
                               speedup(m.cost, none.cost).median, nullptr});
      });
    }
  }
}

}  // namespace quincunx

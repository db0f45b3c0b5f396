#include "bench/sweep_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <set>
#include <utility>

#include "accel/structure.h"
#include "app/render_report.h"
#include "render/coefficient_texels.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t device_bytes(const RenderStats& stats, std::string_view purpose) {
  for (const auto& [name, bytes] : stats.device_bytes)
    if (name == purpose) return bytes;
  return 0;
}

double ratio(std::uint64_t part, std::uint64_t whole) { return whole == 0 ? 0.0 : double(part) / double(whole); }

/// "*" before the best, "+" before what auto chose.
std::string marks(const SweepReport& report, std::size_t setting) {
  return fmt::format("{}{}", setting == report.best() ? "*" : "", report.settings[setting].chosen ? "+" : "");
}

bool both_cell_tests(const SweepReport& report) { return report.choices.cell_tests == CellTests::both; }
const char* cell_test_word(const SweepSetting& setting) { return setting.skip.cell_test ? "on" : "off"; }

/// "grid, 16": a setting in few words, or "none".
std::string short_name(const SweepSetting& setting) {
  return setting.skips() ? fmt::format("{}, {}", setting.label(), setting.skip.block) : setting.label();
}

// ---- tables ----

/// A row of the first table: a structure with or without cell tests, the number of its setting for each block.
struct StructureRow {
  std::string label;
  bool cell_test;
  std::vector<std::size_t> settings;  ///< measured ones
};

std::vector<StructureRow> structure_rows(const SweepReport& report) {
  std::vector<StructureRow> rows;
  for (std::size_t n = 1; n < report.measured.size(); ++n) {
    const SweepSetting& setting = report.settings[n];
    const auto same = [&](const StructureRow& row) {
      return row.label == setting.label() && row.cell_test == setting.skip.cell_test;
    };
    auto row = std::find_if(rows.begin(), rows.end(), same);
    if (row == rows.end()) row = rows.insert(row, {setting.label(), setting.skip.cell_test, {}});
    row->settings.push_back(n);
  }
  const auto& labels = skip_labels();
  const auto place = [&](const StructureRow& row) { return std::find(labels.begin(), labels.end(), row.label); };
  std::stable_sort(rows.begin(), rows.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return rows;
}

/// Whether rows with and without cell tests stand in one table.
bool shows_cell_test(const SweepReport& report) {
  std::set<bool> tests;
  for (const SweepSetting& setting : report.settings)
    if (setting.skips()) tests.insert(setting.skip.cell_test);
  return tests.size() > 1;
}

/// How many times as long as the whole volume's the frames of the same round and view took.
std::vector<double> times_whole(const SweepReport& report, std::size_t n) {
  std::vector<double> times;
  for (std::size_t f = 0; f < report.bricks[n].frame_ms.size(); ++f) times.push_back(report.bricks[n].frame_ms[f] / report.bricks[0].frame_ms[f]);
  return times;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

// ---- JSON and CSV ----

Json setting_json(const SweepReport& report, std::size_t n) {
  const SweepSetting& setting = report.settings[n];
  const SweepMeasurement& m = report.measured[n];
  const RenderStats &scene = m.scene, &stages = m.stages;
  const Spread ms = spread(m.cost.frame_ms), speedup = report.speedup_of(n);
  const std::int64_t axes = scene.block_extents.x + scene.block_extents.y + scene.block_extents.z;
  const double walked = ratio(m.traversal_intervals, m.cost.rays);
  return {{"structure", setting.label()},
          {"block", setting.skips() ? Json(setting.skip.block) : Json()},
          {"cell_test", setting.skip.cell_test},
          {"auto", setting.chosen},
          {"frame_ms_median", ms.median},
          {"frame_ms_p5", ms.p5},
          {"frame_ms_p95", ms.p95},
          {"frame_ms_worst", percentile(m.cost.frame_ms, 1.0)},
          {"segments_ms_median", m.segments_ms.empty() ? 0.0 : percentile(m.segments_ms, 0.5)},
          {"speedup_median", speedup.median},
          {"speedup_p5", speedup.p5},
          {"speedup_p95", speedup.p95},
          {"bounds_ms", stages.bounds_ms},
          {"classify_ms", stages.classify_ms},
          {"cluster_ms", stages.cluster_ms},
          {"build_ms", stages.build_ms},
          {"table_ms", stages.table_ms},
          {"upload_ms", stages.upload_ms},
          {"change_ms", m.change_ms()},
          {"structure_bytes", device_bytes(scene, "structure")},
          {"segments_bytes", device_bytes(scene, "segments")},
          {"occupancy_bytes", device_bytes(scene, "occupancy")},
          {"blocks", scene.blocks},
          {"active_blocks", scene.active_blocks},
          {"active_fraction", scene.blocks == 0 ? Json() : Json(ratio(scene.active_blocks, scene.blocks))},
          {"leaves", scene.leaves},
          {"nodes", scene.nodes},
          {"one_child", scene.one_child},
          {"depth", scene.depth},
          {"evaluations_per_ray", ratio(m.cost.evaluations, m.cost.rays)},
          {"steps_per_ray", ratio(m.steps, m.cost.rays)},
          {"intervals_per_ray", ratio(m.intervals, m.cost.rays)},
          {"traversal_ms", percentile(m.traversal_ms, 0.5)},
          {"traversal_intervals_per_ray", walked},
          {"depth_complexity", axes == 0 ? Json() : Json(walked / double(axes))},
          {"rays", m.cost.rays},
          {"hits", m.cost.hits},
          {"differing_pixels", m.differing_pixels}};
}

Json bricks_json(const SweepReport& report, std::size_t n) {
  const BricksMeasurement& m = report.bricks[n];
  const Spread ms = spread(m.frame_ms), times = spread(times_whole(report, n));
  Json json{{"brick", m.brick > 0 ? Json(m.brick) : Json()},
            {"frame_ms_median", ms.median},
            {"frame_ms_p5", ms.p5},
            {"frame_ms_p95", ms.p95},
            {"times_whole", times.median},
            {"device_bytes", m.device_bytes},
            {"differing_pixels", m.differing_pixels}};
  if (m.brick > 0)
    json.update({{"count", m.first.count}, {"slots", m.first.slots}, {"resident", m.first.resident}, {"first_loads", m.first.loads},
                 {"first_rounds", m.first.rounds}, {"first_load_ms", m.first.load_ms}, {"loads", m.loads}});
  json["frames_ms"] = m.frame_ms;
  return json;
}

const char* cell_tests_word(CellTests tests) {
  return tests == CellTests::on ? "on" : tests == CellTests::off ? "off" : "both";
}

Json choice_json(const SweepReport& report) {
  const auto chosen = std::find_if(report.settings.begin(), report.settings.end(), [](const auto& s) { return s.chosen; });
  if (chosen == report.settings.end()) return Json();
  const std::size_t n = std::size_t(chosen - report.settings.begin());
  const bool known = n < report.measured.size();
  return {{"structure", chosen->label()},
          {"block", chosen->skips() ? Json(chosen->skip.block) : Json()},
          {"cell_test", chosen->skip.cell_test},
          {"times_best", known ? Json(report.median_ms(n) / report.median_ms(report.best())) : Json()}};
}

/// Caption, tables and sentences, the tables as `text` writes them, each sentence ended by `end`.
std::string sweep_page(const SweepReport& report, std::string (*text)(const Table&), std::string_view end) {
  std::string page = fmt::format("{}\n\n{}\n{}\n", sweep_caption(report), text(sweep_frame_table(report)), text(sweep_stage_table(report)));
  if (!report.bricks.empty()) page += fmt::format("{}\n", text(sweep_bricks_table(report)));
  return page + fmt::format("{}{}\n{}{}\n", sweep_choice(report), end, sweep_pictures(report), end);
}

}  // namespace

double SweepReport::median_ms(std::size_t setting) const { return percentile(measured[setting].cost.frame_ms, 0.5); }

std::size_t SweepReport::best() const {
  assert(!measured.empty());
  std::size_t best = 0;
  for (std::size_t n = 1; n < measured.size(); ++n)
    if (median_ms(n) < median_ms(best)) best = n;
  return best;
}

Spread SweepReport::speedup_of(std::size_t setting) const {
  Cost baseline = measured.front().cost;  // has at least as many rounds: none goes first
  baseline.frame_ms.resize(measured[setting].cost.frame_ms.size());
  return speedup(measured[setting].cost, baseline);
}

std::vector<std::string> SweepReport::differing() const {
  std::vector<std::string> all;
  for (std::size_t n = 0; n < measured.size(); ++n)
    if (measured[n].differing_pixels > 0) all.push_back(fmt::format("{}: {} pixels", short_name(settings[n]), measured[n].differing_pixels));
  for (const BricksMeasurement& m : bricks)
    if (m.differing_pixels > 0) all.push_back(fmt::format("bricks of {}: {} pixels", m.brick, m.differing_pixels));
  return all;
}

std::string sweep_subject(const SweepReport& report) {
  std::vector<std::string> parts;
  if (!report.isovalues.empty()) parts.push_back(fmt::format("isovalue{} {}", report.isovalues.size() == 1 ? "" : "s", fmt::join(report.isovalues, ", ")));
  if (report.look) parts.push_back("transfer function " + file_name(report.transfer_function));
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::string sweep_method(const SweepReport& report) {
  std::vector<std::string> parts;
  if (!report.isovalues.empty()) parts.push_back(report.intersect == Intersect::exact ? "exact" : fmt::format("march {}", report.step));
  if (report.look)
    parts.push_back(fmt::format("{}{}, steps of {} cell{}", report.look->classify == Classify::post ? "post" : "pre-integrated",
                                report.look->shade ? "" : ", unlit", report.look->step, report.look->step == 1.0 ? "" : "s"));
  if (report.precision == Precision::float64) parts.push_back("in 64-bit floats");
  if (report.storage != Storage::float32) parts.push_back(fmt::format("coefficients in {}", storage_name(report.storage)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string sweep_caption(const SweepReport& report) {
  const auto count = [](int n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); };
  return fmt::format("{}, {}, {}, {} x {}, {}, {}, {}{}; {}. Medians, milliseconds; speed-up over none. * the best, + what --skip auto chose.",
                     file_name(report.volume), report.spline, sweep_subject(report), report.width, report.height, count(report.views, "view"),
                     count(report.rounds, "round"), sweep_method(report),
                     both_cell_tests(report) ? "" : fmt::format(", cell test {}", cell_tests_word(report.choices.cell_tests)),
                     machine_text(report.machine));
}

Table sweep_frame_table(const SweepReport& report) {
  const bool tests = shows_cell_test(report);
  std::set<int> blocks;
  for (const SweepSetting& setting : report.settings)
    if (setting.skips()) blocks.insert(setting.skip.block);
  Table table{.headings = {"structure"}, .rows = {}, .left = tests ? 2u : 1u};
  if (tests) table.headings.emplace_back("cell test");
  table.headings.emplace_back("none");
  for (const int block : blocks) table.headings.push_back(fmt::format("{}", block));
  table.headings.emplace_back("best speed-up");

  const std::string none = marks(report, 0) + three_digits(report.median_ms(0));
  for (const StructureRow& structure : structure_rows(report)) {
    std::vector<std::string> row{structure.label};
    if (tests) row.emplace_back(structure.cell_test ? "on" : "off");
    row.push_back(none);
    double fastest = 0.0;
    for (const int block : blocks) {
      const auto here = std::find_if(structure.settings.begin(), structure.settings.end(),
                                     [&](std::size_t n) { return report.settings[n].skip.block == block; });
      if (here == structure.settings.end()) {
        row.emplace_back("-");
        continue;
      }
      row.push_back(marks(report, *here) + three_digits(report.median_ms(*here)));
      fastest = std::max(fastest, report.speedup_of(*here).median);
    }
    row.push_back(three_digits(fastest));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table sweep_stage_table(const SweepReport& report) {
  const bool tests = shows_cell_test(report);
  Table table{.headings = {"structure"}, .rows = {}, .left = tests ? 2u : 1u};
  if (tests) table.headings.emplace_back("cell test");
  for (const char* heading : {"block", "blocks", "active", "%", "leaves", "leaves/active %", "nodes", "one child", "depth", "classify", "cluster", "build", "upload", "change",
                              "bytes", "traversal", "frame", "worst", "speed-up"})
    table.headings.emplace_back(heading);
  const auto percent = [](std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? std::string("-") : three_digits(100.0 * double(part) / double(whole));
  };
  for (std::size_t n = 0; n < report.measured.size(); ++n) {
    const SweepSetting& setting = report.settings[n];
    const SweepMeasurement& m = report.measured[n];
    const RenderStats& scene = m.scene;
    std::vector<std::string> row{setting.label()};
    if (tests) row.emplace_back(setting.skips() ? cell_test_word(setting) : "-");
    row.push_back(setting.skips() ? fmt::format("{}", setting.skip.block) : "-");
    row.push_back(fmt::format("{}", scene.blocks));
    row.push_back(fmt::format("{}", scene.active_blocks));
    row.push_back(percent(scene.active_blocks, scene.blocks));
    row.push_back(fmt::format("{}", scene.leaves));
    row.push_back(percent(scene.leaves, scene.active_blocks));
    for (const std::uint64_t number : {scene.nodes, scene.one_child, std::uint64_t(scene.depth)}) row.push_back(number == 0 ? "-" : fmt::format("{}", number));
    for (const double ms : {m.stages.classify_ms, m.stages.cluster_ms, m.stages.build_ms, m.stages.upload_ms})
      row.push_back(three_digits(ms));
    row.push_back(three_digits(m.change_ms()));
    row.push_back(fmt::format("{}", device_bytes(scene, "structure")));
    row.push_back(three_digits(percentile(m.traversal_ms, 0.5)));
    row.push_back(marks(report, n) + three_digits(report.median_ms(n)));
    row.push_back(three_digits(percentile(m.cost.frame_ms, 1.0)));
    row.push_back(three_digits(report.speedup_of(n).median));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table sweep_bricks_table(const SweepReport& report) {
  Table table{.headings = {"brick", "bricks", "slots", "resident", "first loads", "first loading", "later loads", "MiB", "frame", "times whole"}, .rows = {}, .left = 1};
  for (std::size_t n = 0; n < report.bricks.size(); ++n) {
    const BricksMeasurement& m = report.bricks[n];
    std::vector<std::string> row{m.brick > 0 ? fmt::format("{}", m.brick) : "whole volume"};
    for (const std::uint64_t number : {m.first.count, m.first.slots, m.first.resident, m.first.loads})
      row.push_back(m.brick > 0 ? fmt::format("{}", number) : "-");
    row.push_back(m.brick > 0 ? three_digits(m.first.load_ms) : "-");
    row.push_back(m.brick > 0 ? fmt::format("{}", m.loads) : "-");
    row.push_back(three_digits(double(m.device_bytes) / 1048576.0));
    row.push_back(three_digits(percentile(m.frame_ms, 0.5)));
    row.push_back(three_digits(percentile(times_whole(report, n), 0.5)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string sweep_pictures(const SweepReport& report) {
  const std::vector<std::string> differing = report.differing();
  const std::size_t others = report.measured.size() - 1 + (report.bricks.empty() ? 0 : report.bricks.size() - 1);
  if (differing.empty())
    return fmt::format("the pictures of {} other setting{} are those of none, bit for bit", others, others == 1 ? "" : "s");
  return fmt::format("DIFFERENT PICTURES: {}", fmt::join(differing, "; "));
}

std::string sweep_choice(const SweepReport& report) {
  const auto chosen = std::find_if(report.settings.begin(), report.settings.end(), [](const auto& s) { return s.chosen; });
  if (chosen == report.settings.end()) return "auto chose nothing";
  const std::size_t n = std::size_t(chosen - report.settings.begin()), best = report.best();
  std::string text = "auto chose " + chosen->label();
  if (chosen->skips()) text += fmt::format(", blocks of {} cell{}", chosen->skip.block, chosen->skip.block == 1 ? "" : "s");
  if (n >= report.measured.size()) return text + ": not measured";
  if (n == best) return text + ": the best";
  return fmt::format("{}: {:.2f} times the best ({})", text, report.median_ms(n) / report.median_ms(best),
                     short_name(report.settings[best]));
}

Json sweep_json(const SweepReport& report) {
  const Machine& machine = report.machine;
  Json json{{"measurement", "sweep"},
            {"volume", report.volume},
            {"spline", report.spline},
            {"isovalues", report.isovalues},
            {"size", {report.width, report.height}},
            {"orbit", report.views},
            {"repeat", report.rounds},
            {"intersect", report.intersect == Intersect::exact ? "exact" : "march"}};
  if (report.intersect == Intersect::march) json["step"] = report.step;
  json["precision"] = precision_name(report.precision);
  json["storage"] = CoefficientFormat{.precision = report.precision, .storage = report.storage}.name();
  if (report.look) {
    json["transfer_function"] = volume_json(*report.look);
    json["transfer_function"]["file"] = report.transfer_function;
  }
  json["structures"] = report.choices.labels;
  json["blocks"] = report.choices.blocks;
  json["cell_test"] = cell_tests_word(report.choices.cell_tests);
  json["device"] = machine.device;
  json["driver"] = machine.driver;
  json["processor"] = machine.processor;
  json["cores"] = machine.cores;
  json["planned"] = report.settings.size();
  json["measured"] = report.measured.size();
  json["auto"] = choice_json(report);
  json["best"] = report.best();
  for (std::size_t n = 0; n < report.measured.size(); ++n) {
    Json setting = setting_json(report, n);
    setting["frames_ms"] = report.measured[n].cost.frame_ms;
    setting["traversals_ms"] = report.measured[n].traversal_ms;
    json["settings"].push_back(std::move(setting));
  }
  for (std::size_t n = 0; n < report.bricks.size(); ++n) json["bricks"].push_back(bricks_json(report, n));
  return json;
}

std::string sweep_csv(const SweepReport& report) {
  std::string text;
  for (std::size_t n = 0; n < report.measured.size(); ++n) {
    std::vector<std::string> keys, values;
    const Json setting = setting_json(report, n);
    for (const auto& [key, value] : setting.items()) {
      keys.push_back(key);
      values.push_back(value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump());
    }
    if (n == 0) text += fmt::format("{}\n", fmt::join(keys, ","));
    text += fmt::format("{}\n", fmt::join(values, ","));
  }
  return text;
}

std::string sweep_markdown(const SweepReport& report) { return sweep_page(report, markdown_text, "."); }
std::string sweep_text(const SweepReport& report) { return sweep_page(report, plain_text, ""); }

}  // namespace quincunx

#include "bench/intersect_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

double evaluations_per_ray(const Cost& cost) { return double(cost.evaluations) / double(cost.rays); }

/// Two significant digits: "3.1e-05".
std::string small(double x) { return x == 0.0 ? "0" : fmt::format("{:.1e}", x); }

Json to_json(const HitErrors& errors) {
  return {{"missed", errors.missed},
          {"false", errors.false_hits},
          {"wrong_sheet", errors.wrong_sheet},
          {"depth_rms_cells", errors.depth_rms},
          {"depth_p99_cells", errors.depth_p99},
          {"normal_rms_degrees", errors.normal_rms},
          {"residual_max_cells", errors.residual_max}};
}

}  // namespace

const Cost& IntersectReport::baseline() const {
  const auto place = std::find(settings.begin(), settings.end(), published_setting());
  assert(place != settings.end());
  return costs[std::size_t(place - settings.begin())];
}

Table intersect_table(const IntersectReport& report) {
  Table table{.headings = {"method", "skip", "ms", "p5", "p95", "speed-up", "evaluations/ray"}, .rows = {}, .left = 2};
  if (!report.errors.empty()) {
    for (const char* heading :
         {"missed", "false", "wrong sheet", "depth RMS", "depth p99", "normal RMS", "residual max"})
      table.headings.emplace_back(heading);
  }
  for (std::size_t s = 0; s < report.settings.size(); ++s) {
    const Cost& cost = report.costs[s];
    const Spread ms = spread(cost.frame_ms);
    std::vector<std::string> row{report.settings[s].method(),
                                 report.settings[s].structure,
                                 three_digits(ms.median),
                                 three_digits(ms.p5),
                                 three_digits(ms.p95),
                                 three_digits(speedup(cost, report.baseline()).median),
                                 fmt::format("{:.1f}", evaluations_per_ray(cost))};
    if (!report.errors.empty()) {
      const HitErrors& e = report.errors[s];
      for (const std::uint64_t count : {e.missed, e.false_hits, e.wrong_sheet}) row.push_back(fmt::format("{}", count));
      for (const double error : {e.depth_rms, e.depth_p99, e.normal_rms, e.residual_max}) row.push_back(small(error));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string intersect_caption(const IntersectReport& report) {
  const auto count = [](int n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); };
  std::string text = fmt::format("{}, isovalue {}, {} x {}, {}, {} of each setting in turns, blocks of {} cells; {}.",
                                 std::filesystem::path(report.volume).filename().string(), report.isovalue,
                                 report.width, report.height, count(report.views, "view"),
                                 count(report.rounds, "timed frame"), report.block, machine_text(report.machine));
  if (!report.errors.empty()) {
    text +=
        fmt::format(" The reference hits {} of {} rays.", report.errors.front().expected, report.costs.front().rays);
  }
  return text;
}

Json intersect_json(const IntersectReport& report) {
  const Machine& machine = report.machine;
  const Setting published = published_setting();
  Json json{{"measurement", "intersect"},
            {"volume", report.volume},
            {"isovalue", report.isovalue},
            {"size", {report.width, report.height}},
            {"views", report.views},
            {"repeat", report.rounds},
            {"block", report.block},
            {"device", machine.device},
            {"driver", machine.driver},
            {"processor", machine.processor},
            {"cores", machine.cores},
            {"rays", report.costs.front().rays},
            {"baseline", published.method() + " " + published.structure}};
  if (!report.errors.empty()) json["reference_hits"] = report.errors.front().expected;
  for (std::size_t s = 0; s < report.settings.size(); ++s) {
    const Setting& setting = report.settings[s];
    const Cost& cost = report.costs[s];
    Json entry{{"intersect", setting.intersect == Intersect::exact ? "exact" : "march"}};
    if (setting.intersect == Intersect::march) entry["step"] = setting.step;
    entry["structure"] = setting.structure;
    entry["trace_ms"] = spread_json(spread(cost.frame_ms));
    entry["speedup"] = spread_json(speedup(cost, report.baseline()));
    entry["evaluations_per_ray"] = evaluations_per_ray(cost);
    entry["hits"] = cost.hits;
    if (!report.errors.empty()) entry["error"] = to_json(report.errors[s]);
    json["settings"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace quincunx

#include "bench/precision_report.h"

#include <fmt/format.h>

#include <cassert>
#include <filesystem>

namespace quincunx {

using Json = nlohmann::ordered_json;

Spread times_float(const PrecisionReport& report) {
  assert(report.lines.size() == 2);
  return speedup(report.lines[0].cost, report.lines[1].cost);
}

Table precision_table(const PrecisionReport& report) {
  Table table{.headings = {"precision", "ms", "p5", "p95", "times float", "missed", "false", "wrong sheet", "depth RMS", "normal RMS", "coefficients, MB", "device, MB"},
              .rows = {},
              .left = 1};
  for (const PrecisionLine& line : report.lines) {
    const Spread ms = spread(line.cost.frame_ms);
    const HitErrors& e = line.errors;
    const bool doubles = line.precision == Precision::float64;
    table.rows.push_back({precision_name(line.precision), three_digits(ms.median), three_digits(ms.p5), three_digits(ms.p95),
                          doubles ? fmt::format("{:.2f}", times_float(report).median) : "1", fmt::format("{}", e.missed), fmt::format("{}", e.false_hits),
                          fmt::format("{}", e.wrong_sheet), fmt::format("{:.1e}", e.depth_rms), fmt::format("{:.1e}", e.normal_rms),
                          fmt::format("{:.1f}", 1e-6 * double(line.coefficient_bytes)), fmt::format("{:.1f}", 1e-6 * double(line.device_bytes))});
  }
  return table;
}

std::string precision_caption(const PrecisionReport& report) {
  const PrecisionLine& first = report.lines.front();
  return fmt::format("{}, isovalue {:g}, {} x {}, {} view{}, {} timed frame{} of each in turns; {}. The reference hits {} of {} rays.",
                     std::filesystem::path(first.volume).filename().string(), first.isovalue, report.width, report.height, report.views,
                     report.views == 1 ? "" : "s", report.rounds, report.rounds == 1 ? "" : "s", machine_text(report.machine), first.errors.expected,
                     first.cost.rays);
}

Json precision_json(const PrecisionReport& report) {
  const PrecisionLine& first = report.lines.front();
  const auto spread_json = [](const Spread& s) { return Json{{"median", s.median}, {"p5", s.p5}, {"p95", s.p95}}; };
  Json json{{"measurement", "precision"}, {"volume", first.volume},
            {"isovalue", first.isovalue}, {"size", {report.width, report.height}},
            {"views", report.views},      {"repeat", report.rounds},
            {"device", report.machine.device}, {"driver", report.machine.driver},
            {"processor", report.machine.processor}, {"cores", report.machine.cores},
            {"reference_hits", first.errors.expected}, {"times_float", spread_json(times_float(report))}};
  for (const PrecisionLine& line : report.lines) {
    const HitErrors& e = line.errors;
    json["precisions"].push_back({{"precision", precision_name(line.precision)},
                                  {"trace_ms", spread_json(spread(line.cost.frame_ms))},
                                  {"hits", line.cost.hits},
                                  {"error", {{"missed", e.missed}, {"false", e.false_hits}, {"wrong_sheet", e.wrong_sheet}, {"depth_rms_cells", e.depth_rms},
                                             {"depth_p99_cells", e.depth_p99}, {"normal_rms_degrees", e.normal_rms}, {"residual_max_cells", e.residual_max}}},
                                  {"coefficient_bytes", line.coefficient_bytes},
                                  {"device_bytes", line.device_bytes}});
  }
  return json;
}

}  // namespace quincunx

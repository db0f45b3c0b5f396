#include "bench/steps_report.h"

#include <fmt/format.h>

#include <cmath>

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

constexpr StepLine::Way StepLine::*kWays[] = {&StepLine::post, &StepLine::pre_integrated};
constexpr const char* kNames[] = {"post", "pre-integrated"};

std::string order_text(double order) { return order == 0.0 ? "-" : fmt::format("{:.2f}", order); }

double order_of(const StepsReport& report, std::size_t n, StepLine::Way StepLine::*way) {
  return n == 0 ? 0.0 : order_between(report.lines[n - 1], report.lines[n], way);
}

}  // namespace

double order_between(const StepLine& before, const StepLine& line, StepLine::Way StepLine::*way) {
  if (before.spline != line.spline) return 0.0;
  return std::log((before.*way).rms / (line.*way).rms) / std::log(before.step / line.step);
}

Table steps_table(const StepsReport& report) {
  Table table{.headings = {"spline", "step"}, .rows = {}, .left = 1};
  for (const char* name : kNames)
    for (const char* what : {"RMS", "order", "largest", "ms"}) table.headings.push_back(fmt::format("{}, {}", name, what));
  for (std::size_t n = 0; n < report.lines.size(); ++n) {
    const StepLine& line = report.lines[n];
    std::vector<std::string> row{line.spline, fmt::format("{}", line.step)};
    for (const auto way : kWays) {
      row.push_back(fmt::format("{:.1e}", (line.*way).rms));
      row.push_back(order_text(order_of(report, n, way)));
      row.push_back(fmt::format("{:.1e}", (line.*way).largest));
      row.push_back((line.*way).frame_ms.empty() ? "-" : three_digits(spread((line.*way).frame_ms).median));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string steps_caption(const StepsReport& report) {
  const StepsPlan& plan = report.plan;
  return fmt::format(
      "Opacity of a ball of 0.64 - |x|^2 against its closed form: steps in cells of {0} or {1} an axis, errors of alpha (0..1) over the pixels that the "
      "ball covers, the order by which they fall from one step to the next; {2} x {2}, medians of {3} frame{4} in turns; {5}.",
      plan.cells, plan.cells - 1, plan.size, plan.rounds, plan.rounds == 1 ? "" : "s", machine_text(report.machine));
}

Json steps_json(const StepsReport& report) {
  Json json{{"measurement", "steps"},        {"cells", report.plan.cells},          {"size", report.plan.size},
            {"repeat", report.plan.rounds},  {"device", report.machine.device},     {"driver", report.machine.driver},
            {"processor", report.machine.processor}, {"cores", report.machine.cores}};
  for (std::size_t n = 0; n < report.lines.size(); ++n) {
    const StepLine& line = report.lines[n];
    Json row{{"spline", line.spline}, {"step", line.step}};
    for (std::size_t w = 0; w < std::size(kWays); ++w) {
      const StepLine::Way& way = line.*kWays[w];
      const double order = order_of(report, n, kWays[w]);
      row[kNames[w]] = {{"rms", way.rms}, {"largest", way.largest}, {"order", order == 0.0 ? Json() : Json(order)}, {"frames_ms", way.frame_ms}};
    }
    json["lines"].push_back(std::move(row));
  }
  return json;
}

}  // namespace quincunx

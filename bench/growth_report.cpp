#include "bench/growth_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace quincunx {

using Json = nlohmann::ordered_json;

double growth_per_doubling(const GrowthReport& report, const GrowthLine& line, std::size_t n) {
  const double doublings = std::log2(double(report.sizes[n + 1]) / double(report.sizes[n]));
  return std::pow(line.frame_ms[n + 1] / line.frame_ms[n], 1.0 / doublings);
}

Table growth_table(const GrowthReport& report) {
  Table table{.headings = {"field", "structure"}, .rows = {}, .left = 2};
  for (const int size : report.sizes) table.headings.push_back(fmt::format("{}", size));
  for (std::size_t n = 0; n + 1 < report.sizes.size(); ++n)
    table.headings.push_back(fmt::format("{} to {}", report.sizes[n], report.sizes[n + 1]));
  for (const GrowthLine& line : report.lines) {
    std::vector<std::string> row{line.field, line.label};
    for (const double ms : line.frame_ms) row.push_back(three_digits(ms));
    for (std::size_t n = 0; n + 1 < report.sizes.size(); ++n)
      row.push_back(fmt::format("{:.2f}", growth_per_doubling(report, line, n)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string growth_caption(const GrowthReport& report) {
  return fmt::format(
      "Median frame times in ms for n^3 x 2 samples of one object, {} x {}, {} frame{} of each setting in turns, the better of blocks of {} "
      "cells; last, the factor for a doubled edge. {}.",
      report.width, report.height, report.rounds, report.rounds == 1 ? "" : "s", fmt::join(report.blocks, ", "),
      machine_text(report.machine));
}

Json growth_json(const GrowthReport& report) {
  const Machine& machine = report.machine;
  Json json{{"measurement", "growth"},
            {"sizes", report.sizes},
            {"blocks", report.blocks},
            {"size", {report.width, report.height}},
            {"repeat", report.rounds},
            {"device", machine.device},
            {"driver", machine.driver},
            {"processor", machine.processor},
            {"cores", machine.cores}};
  for (const GrowthLine& line : report.lines) {
    Json entry{{"field", line.field}, {"structure", line.label}, {"frame_ms", line.frame_ms}, {"block", line.block}};
    entry["per_doubling"] = Json::array();
    for (std::size_t n = 0; n + 1 < report.sizes.size(); ++n)
      entry["per_doubling"].push_back(growth_per_doubling(report, line, n));
    json["lines"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace quincunx

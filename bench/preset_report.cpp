#include "bench/preset_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "bench/presets.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

std::string table_cell(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? three_digits(value.get<double>()) : value.dump();
}

/// As RFC 4180 has it.
std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string page(const PresetReport& report, std::string (*table)(const Table&)) {
  const std::string pictures = preset_pictures(report);
  std::string text = preset_caption(report) + "\n\n" + table(preset_table(report));
  if (!pictures.empty()) text += "\n" + pictures + "\n";
  return text;
}

}  // namespace

std::size_t PresetReport::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  assert(found != columns.end());
  return std::size_t(found - columns.begin());
}

std::string preset_pictures(const PresetReport& report) {
  if (!report.differing.empty()) return fmt::format("DIFFERENT PICTURES: {}", fmt::join(report.differing, "; "));
  if (report.compared == 0) return "";
  return fmt::format("The pictures of {} other setting{} are those of none, bit for bit.", report.compared, report.compared == 1 ? "" : "s");
}

std::string preset_caption(const PresetReport& report) {
  const Preset& preset = *report.preset;
  std::string text = fmt::format("{}: {}, after {}.", preset.name, preset.shows, preset.paper);
  if (!report.setup.empty()) text += " " + report.setup;
  for (const std::string& note : report.notes) text += " " + note;
  text += fmt::format(" Measured {}{}. Published: {}", report.machine.device.empty() ? "" : "with ", machine_text(report.machine), preset.published);
  return report.whole ? text : text + " INTERRUPTED: rows are missing.";
}

Table preset_table(const PresetReport& report) {
  Table table{.headings = report.columns, .rows = {}, .left = report.left};
  for (std::string& heading : table.headings) std::replace(heading.begin(), heading.end(), '_', ' ');
  for (const auto& row : report.rows) {
    std::vector<std::string> words;
    for (const Json& value : row) words.push_back(table_cell(value));
    table.rows.push_back(std::move(words));
  }
  return table;
}

Json preset_json(const PresetReport& report) {
  const Preset& preset = *report.preset;
  const Machine& machine = report.machine;
  Json json{{"measurement", "preset"}, {"preset", preset.name},          {"shows", preset.shows},     {"paper", preset.paper},
            {"published", preset.published}, {"full", report.full},      {"whole", report.whole},     {"setup", report.setup},
            {"notes", report.notes},   {"device", machine.device},       {"driver", machine.driver},  {"processor", machine.processor},
            {"cores", machine.cores},  {"pictures_compared", report.compared}, {"differing", report.differing}, {"rows", Json::array()}};
  for (const auto& row : report.rows) {
    Json object = Json::object();
    for (std::size_t c = 0; c < row.size(); ++c) object[report.columns[c]] = row[c];
    json["rows"].push_back(std::move(object));
  }
  return json;
}

std::string preset_csv(const PresetReport& report) {
  std::string text = fmt::format("{}\n", fmt::join(report.columns, ","));
  for (const auto& row : report.rows) {
    std::vector<std::string> values;
    for (const Json& value : row) values.push_back(csv_cell(value));
    text += fmt::format("{}\n", fmt::join(values, ","));
  }
  return text;
}

std::string preset_markdown(const PresetReport& report) { return page(report, markdown_text); }
std::string preset_text(const PresetReport& report) { return page(report, plain_text); }

}  // namespace quincunx

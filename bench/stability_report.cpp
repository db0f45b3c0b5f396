#include "bench/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/html.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

/// Two digits, with an exponent where that is shorter; 0 as 0.
std::string short_number(double x) { return x == 0.0 ? "0" : x >= 0.01 && x < 1000.0 ? fmt::format("{:.2g}", x) : fmt::format("{:.1e}", x); }
std::string passed_text(bool passed) { return passed ? "pass" : "FAIL"; }

std::uint64_t lost(const Verdict& v) { return v.holes + v.wrong + v.not_finite; }

StabilitySection cases_section(const StabilityReport& report) {
  StabilitySection section{
      "The catalogue",
      fmt::format("value, gradient: the largest error at random points in units of e m (e = 2^-24, m the largest coefficient near). hits: of the double-precision reference. holes, wrong: first hits "
                  "lost or misplaced beyond doubt; undecided: other outcomes than the reference's that rounding excuses. depth: cells, where the surface is not grazed. residual, normal part: the "
                  "largest |f - isovalue| at a hit and the largest angle between normal and gradient, in parts of what is allowed. double: outcomes left undecided by kernels of 64-bit floats, judged alike. march: holes and wrong hits of a march of {} cells, of the same pixels.",
                  report.step),
      {.headings = {"group", "case", "spline", "value, e m", "gradient, e m", "rays", "hits", "holes", "wrong", "undecided", "not finite", "depth", "residual", "normal, deg", "normal part", "double", "march", ""},
       .rows = {},
       .left = 3}};
  for (const StabilityLine& line : report.lines) {
    const Verdict& v = line.exact;
    section.table.rows.push_back({line.group, line.name, line.spline, short_number(line.evaluation.value), short_number(line.evaluation.gradient),
                                  fmt::format("{}", v.rays), fmt::format("{}", v.expected), fmt::format("{}", v.holes), fmt::format("{}", v.wrong),
                                  fmt::format("{}", v.undecided), fmt::format("{}", v.not_finite), short_number(v.depth), short_number(v.residual),
                                  short_number(v.normal), short_number(v.normal_part), line.doubled() ? fmt::format("{}", line.doubles.undecided) : "-",
                                  line.marched() ? fmt::format("{}", lost(line.march)) : "-", passed_text(line.passed())});
  }
  return section;
}

StabilitySection roots_section(const StabilityReport& report) {
  StabilitySection section{"Roots along a line",
                           "Polynomials in Bernstein form with known roots, rounded to floats. missed: no root, or one behind a certain one; wrong: where the value is none within rounding; residual: the "
                           "largest |p| at a root, in parts of what is allowed; off: the largest distance from the root in double, of [0,1], where the slope is a tenth of the largest coefficient or more.",
                           {.headings = {"degree", "polynomials", "count", "missed", "wrong", "undecided", "residual", "off", ""}, .rows = {}, .left = 2}};
  for (const RootsLine& line : report.roots)
    section.table.rows.push_back({fmt::format("{}", line.degree), line.kind, fmt::format("{}", line.count), fmt::format("{}", line.missed), fmt::format("{}", line.wrong),
                                  fmt::format("{}", line.undecided), short_number(line.residual), short_number(line.off), passed_text(line.passed())});
  return section;
}

StabilitySection watertight_section(const StabilityReport& report) {
  StabilitySection section{"Watertight",
                           "Closed analytic surfaces sampled on 64^3 x 2 or 128^3 points, random cameras. rays: those that certainly pass through the inside; leaks: of these, no hit before they are inside. off: "
                           "cells, the farthest that any hit is from the analytic surface (reconstruction error included).",
                           {.headings = {"surface", "spline", "rays", "leaks", "hits", "off", ""}, .rows = {}, .left = 2}};
  for (const WatertightLine& line : report.watertight)
    section.table.rows.push_back({line.surface, line.spline, fmt::format("{}", line.rays), fmt::format("{}", line.leaks), fmt::format("{}", line.hits), short_number(line.off),
                                  passed_text(line.passed())});
  return section;
}

Json verdict_json(const Verdict& v) {
  return {{"rays", v.rays},           {"expected", v.expected},     {"hits", v.hits},   {"holes", v.holes},       {"wrong", v.wrong},   {"undecided", v.undecided},
          {"not_finite", v.not_finite}, {"depth", v.depth}, {"residual", v.residual}, {"normal", v.normal}, {"normal_part", v.normal_part}};
}

std::string failed_row(const std::vector<std::string>& row) { return row.back() == "pass" ? "" : "fail"; }

}  // namespace

StabilityScore stability_score(const StabilityReport& report) {
  StabilityScore score;
  const auto count = [&](const auto& lines) {
    for (const auto& line : lines) score.passed += line.passed(), ++score.all;
  };
  count(report.lines);
  count(report.roots);
  count(report.watertight);
  return score;
}

std::vector<StabilitySection> stability_sections(const StabilityReport& report) {
  std::vector<StabilitySection> sections;
  if (!report.lines.empty()) sections.push_back(cases_section(report));
  if (!report.roots.empty()) sections.push_back(roots_section(report));
  if (!report.watertight.empty()) sections.push_back(watertight_section(report));
  return sections;
}

std::string stability_csv(const StabilityReport& report) {
  std::string csv =
      "group,case,spline,isovalue,value_em,value_allowed_em,gradient_em,gradient_allowed_em,rays,expected,hits,holes,wrong,undecided,not_finite,depth_cells,residual_part,normal_degrees,normal_part,"
      "double_holes,double_wrong,double_undecided,double_residual_part,march_holes,march_wrong,march_depth_cells,passed\n";
  for (const StabilityLine& line : report.lines) {
    const Verdict& v = line.exact;
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", line.group, csv_text(line.name), line.spline, line.isovalue, line.evaluation.value,
                       line.evaluation.value_allowed, line.evaluation.gradient, line.evaluation.gradient_allowed, v.rays, v.expected, v.hits, v.holes, v.wrong, v.undecided, v.not_finite, v.depth,
                       v.residual, v.normal, v.normal_part, line.doubles.holes, line.doubles.wrong, line.doubles.undecided, line.doubles.residual, line.march.holes, line.march.wrong, line.march.depth, line.passed());
  }
  return csv;
}

Json stability_json(const StabilityReport& report) {
  const StabilityScore score = stability_score(report);
  const Machine& machine = report.machine;
  Json json{{"measurement", "stability"}, {"command", report.command}, {"device", machine.device}, {"driver", machine.driver}, {"processor", machine.processor},
            {"cores", machine.cores},     {"step", report.step},       {"seed", report.seed},      {"passed", score.passed},   {"all", score.all}};
  json["cases"] = Json::array();
  for (const StabilityLine& line : report.lines) {
    json["cases"].push_back({{"group", line.group},
                             {"case", line.name},
                             {"spline", line.spline},
                             {"isovalue", line.isovalue},
                             {"value_em", line.evaluation.value},
                             {"value_allowed_em", line.evaluation.value_allowed},
                             {"gradient_em", line.evaluation.gradient},
                             {"gradient_allowed_em", line.evaluation.gradient_allowed},
                             {"exact", verdict_json(line.exact)},
                             {"double", verdict_json(line.doubles)},
                             {"march", verdict_json(line.march)},
                             {"passed", line.passed()}});
  }
  json["roots"] = Json::array();
  for (const RootsLine& line : report.roots) {
    json["roots"].push_back({{"degree", line.degree}, {"polynomials", line.kind}, {"count", line.count}, {"missed", line.missed}, {"wrong", line.wrong}, {"undecided", line.undecided},
                             {"residual", line.residual}, {"off", line.off}, {"passed", line.passed()}});
  }
  json["watertight"] = Json::array();
  for (const WatertightLine& line : report.watertight) {
    json["watertight"].push_back({{"surface", line.surface}, {"spline", line.spline}, {"rays", line.rays}, {"leaks", line.leaks}, {"hits", line.hits}, {"off_cells", line.off}, {"passed", line.passed()}});
  }
  return json;
}

std::string stability_markdown(const StabilityReport& report) {
  std::string text;
  for (const StabilitySection& section : stability_sections(report)) text += fmt::format("### {}\n\n{}\n{}\n\n", section.title, markdown_text(section.table), section.caption);
  return text + machine_text(report.machine) + ".\n";
}

std::string stability_html(const StabilityReport& report) {
  const StabilityScore score = stability_score(report);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>Quincunx: stability</title><style>{}</style></head>\n<body>\n"
      "<h1>Numerical stability: {} of {} passed</h1>\n<p><code>{}</code><br>{}</p>\n",
      kPageStyle, score.passed, score.all, html_text(report.command), html_text(machine_text(report.machine)));
  for (const StabilitySection& section : stability_sections(report))
    page += fmt::format("<h2>{}</h2>\n<p>{}</p>\n{}", html_text(section.title), html_text(section.caption), html_table(section.table, failed_row));
  return page + "</body></html>\n";
}

}  // namespace quincunx

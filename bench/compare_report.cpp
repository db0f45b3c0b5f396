#include "bench/compare_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "accel/structure.h"
#include "app/render_report.h"
#include "bench/html.h"
#include "bench/timing.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

/// Three digits, with an exponent where that is shorter; 0 as 0.
std::string number(double x) { return x == 0.0 ? "0" : x >= 0.001 && x < 1e6 ? three_digits(x) : fmt::format("{:.1e}", x); }

/// Of FrameErrors that are there, or of VolumeErrors.
template <double FrameErrors::*Member>
std::optional<double> of_truth(const CompareLine& line) {
  if (!line.truth) return std::nullopt;
  return (*line.truth).*Member;
}
template <double VolumeErrors::*Member>
std::optional<double> of_volume(const CompareLine& line) {
  if (!line.volume) return std::nullopt;
  return (*line.volume).*Member;
}

Json to_json(const FrameErrors& e) {
  return {{"compared", e.compared},   {"expected", e.expected},   {"missed", e.missed},       {"false_hits", e.false_hits}, {"wrong_sheet", e.wrong_sheet},
          {"wrong_percent", e.wrong_percent()}, {"depth_rms_cells", e.depth_rms}, {"depth_p99_cells", e.depth_p99}, {"depth_max_cells", e.depth_max},
          {"normal_rms_degrees", e.normal_rms}, {"normal_p99_degrees", e.normal_p99}};
}

Json to_json(const VolumeErrors& e) {
  return {{"value_rmse", e.value_rmse}, {"value_max", e.value_max}, {"gradient_rmse", e.gradient_rmse}, {"angle_rms_degrees", e.angle_rms}, {"angle_p99_degrees", e.angle_p99}};
}

std::string dimensions(const Volume& volume) {
  const Extents& n = volume.extents;
  return fmt::format("{} x {} x {}{}", n.x, n.y, n.z, volume.lattice == LatticeKind::bcc ? " x 2" : "");
}

std::uint64_t sample_count(const Volume& volume) {
  return std::uint64_t(coset_count(volume.lattice)) * std::uint64_t(volume.extents.x * volume.extents.y * volume.extents.z);
}

CompareSection volumes_section(const CompareReport& report) {
  CompareSection section{"What was sampled", fmt::format("step: the world length of one lattice coordinate, beside that of the first volume{}.", report.subject->made.empty() ? "" : "; " + report.subject->made),
                         {.headings = {"volume", "lattice", "dimensions", "samples", "step"}, .rows = {}, .left = 3}};
  const std::vector<CompareVolume>& volumes = report.subject->volumes;
  for (const CompareVolume& v : volumes)
    section.table.rows.push_back({v.name, std::string(lattice_name(v.volume.lattice)), dimensions(v.volume), fmt::format("{}", sample_count(v.volume)),
                                  fmt::format("{:.4f}", cell_length(v.volume.world) / cell_length(volumes.front().volume.world))});
  return section;
}

/// The columns of errors of first hits.
void append_headings(std::vector<std::string>& headings, const char* against) {
  for (const char* what : {"wrong %", "depth", "p99", "max", "normal", "p99"}) headings.push_back(fmt::format("{} {}", against, what));
}
void append_cells(std::vector<std::string>& row, const FrameErrors& e) {
  for (const double x : {e.wrong_percent(), e.depth_rms, e.depth_p99, e.depth_max, e.normal_rms, e.normal_p99}) row.push_back(number(x));
}

CompareSection lines_section(const CompareReport& report) {
  const bool truth = report.subject->truth != nullptr;
  CompareSection section{
      "Error and time",
      fmt::format("ms: median of a frame, with the 5th and the 95th percentile. wrong: first hits lost, false or on another sheet, of the pixels in which either has one. depth: RMS, 99th percentile and "
                  "largest of the others, in cells ({}). normal: degrees. ref: against the double-precision reference of the same spline, intersection alone. {}image, SSIM: of the pictures, against "
                  "that of the {}. front: no other is both faster and less wrong ({}).",
                  report.subject->volumes.size() > 1 ? "Cartesian steps" : "of the volume",
                  truth ? fmt::format("true: against what was sampled, but for pixels in which either hit is within {:g} cells of a face of the domain. ", report.subject->border) : "",
                  truth ? "truth" : "reference", report.metric->title),
      {.headings = {"spline", "volume", "prefilter", "storage", "hit", "normal", "skip", "ms", "p5", "p95"}, .rows = {}, .left = 7}};
  std::vector<std::string>& headings = section.table.headings;
  append_headings(headings, "ref");
  if (truth) append_headings(headings, "true");
  headings.insert(headings.end(), {"image", "SSIM", "front"});
  const std::vector<CompareLine>& lines = report.measured.lines;
  const std::vector<std::size_t> front = pareto_front(lines, *report.metric);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const CompareLine& line = lines[n];
    const CompareSetting& s = line.setting;
    const Spread ms = spread(line.frame_ms);
    std::vector<std::string> row{s.spline, report.subject->volumes[s.volume].name, s.prefilter_text(), storage_name(s.storage), s.method(), s.normal.label(), skip_label(s.skip),
                                 three_digits(ms.median), three_digits(ms.p5), three_digits(ms.p95)};
    append_cells(row, line.reference);
    if (line.truth) append_cells(row, *line.truth);
    row.insert(row.end(), {number(line.image_rmse), fmt::format("{:.4f}", line.ssim), std::find(front.begin(), front.end(), n) != front.end() ? "*" : ""});
    section.table.rows.push_back(std::move(row));
  }
  return section;
}

CompareSection volume_section(const CompareReport& report) {
  CompareSection section{"Reconstruction alone",
                         fmt::format("Values and gradients in double precision at {} random points (seed {}) more than {:g} cells from the faces of the domain. value: root of the mean square, and largest. "
                                     "gradient: likewise of the vector, per world unit. angle: degrees, RMS and 99th percentile.",
                                     report.plan.points, report.plan.seed, report.subject->border),
                         {.headings = {"spline", "volume", "prefilter", "storage", "normal", "value", "max", "gradient", "angle", "p99"}, .rows = {}, .left = 5}};
  std::vector<const CompareLine*> seen;
  for (const CompareLine& line : report.measured.lines) {
    const CompareSetting& s = line.setting;
    if (!line.volume || std::any_of(seen.begin(), seen.end(), [&](const CompareLine* other) { return other->setting.same_reconstruction(s); })) continue;
    seen.push_back(&line);
    const VolumeErrors& e = *line.volume;
    section.table.rows.push_back({s.spline, report.subject->volumes[s.volume].name, s.prefilter_text(), storage_name(s.storage), s.normal.label(), number(e.value_rmse), number(e.value_max),
                                  number(e.gradient_rmse), number(e.angle_rms), number(e.angle_p99)});
  }
  return section;
}

}  // namespace

const std::vector<CompareMetric>& compare_metrics() {
  static const std::vector<CompareMetric> metrics{
      {"wrong", "wrong first hits, %", true, [](const CompareLine& l) { return l.truth ? std::optional(l.truth->wrong_percent()) : std::nullopt; }},
      {"depth", "depth of hits, RMS, cells", true, of_truth<&FrameErrors::depth_rms>},
      {"normal", "normals, RMS, degrees", true, of_truth<&FrameErrors::normal_rms>},
      {"value", "values, RMSE", true, of_volume<&VolumeErrors::value_rmse>},
      {"gradient", "gradients, RMS, degrees", true, of_volume<&VolumeErrors::angle_rms>},
      {"image", "image, RMSE", false, [](const CompareLine& l) { return std::optional(l.image_rmse); }},
      {"ssim", "image, 1 - SSIM", false, [](const CompareLine& l) { return std::optional(std::max(1.0 - l.ssim, 0.0)); }},
      {"ref-wrong", "wrong first hits beside the reference of the spline, %", false, [](const CompareLine& l) { return std::optional(l.reference.wrong_percent()); }},
      {"ref-depth", "depth of hits beside the reference of the spline, RMS, cells", false, [](const CompareLine& l) { return std::optional(l.reference.depth_rms); }},
      {"ref-normal", "normals beside the reference of the spline, RMS, degrees", false, [](const CompareLine& l) { return std::optional(l.reference.normal_rms); }},
  };
  return metrics;
}

const CompareMetric& compare_metric(std::string_view name) {
  std::vector<std::string_view> names;
  for (const CompareMetric& metric : compare_metrics()) {
    if (metric.name == name) return metric;
    names.push_back(metric.name);
  }
  throw InputError(fmt::format("--error: found {}, expected one of {}", name, fmt::join(names, ", ")));
}

std::vector<const CompareMetric*> CompareReport::metrics() const {
  std::vector<const CompareMetric*> known;
  for (const CompareMetric& m : compare_metrics())
    if (subject->truth || !m.against_truth) known.push_back(&m);
  return known;
}

double median_ms(const CompareLine& line) { return percentile(line.frame_ms, 0.5); }

std::vector<std::size_t> pareto_front(const std::vector<CompareLine>& lines, const CompareMetric& metric) {
  std::vector<std::size_t> order(lines.size()), front;
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto error = [&](std::size_t n) { return metric.value(lines[n]).value(); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double ta = median_ms(lines[a]), tb = median_ms(lines[b]);
    return ta != tb ? ta < tb : error(a) < error(b);
  });
  for (const std::size_t n : order)
    if (front.empty() || error(n) < error(front.back())) front.push_back(n);
  return front;
}

std::string compare_caption(const CompareReport& report) {
  return fmt::format("{}, isovalue {:g}, {} x {} pixels, {}, median of {} frames each, in turns", report.subject->name, report.subject->isovalue, report.plan.width, report.plan.height,
                     report.plan.views == 1 ? "one view" : fmt::format("{} views", report.plan.views), report.plan.views * report.plan.rounds);
}

std::vector<CompareSection> compare_sections(const CompareReport& report) {
  std::vector<CompareSection> sections{lines_section(report)};
  if (report.subject->truth) sections.push_back(volume_section(report));
  sections.push_back(volumes_section(report));
  return sections;
}

std::string compare_csv(const CompareReport& report) {
  std::string csv =
      "spline,volume,lattice,prefilter,storage,intersect,step,normal,delta,skip,ms_median,ms_p5,ms_p95,coefficient_bytes,ref_wrong_percent,ref_missed,ref_false,ref_wrong_sheet,ref_depth_rms,ref_depth_p99,"
      "ref_depth_max,ref_normal_rms,ref_normal_p99,image_rmse,ssim,true_wrong_percent,true_missed,true_false,true_wrong_sheet,true_depth_rms,true_depth_p99,true_depth_max,true_normal_rms,"
      "true_normal_p99,value_rmse,value_max,gradient_rmse,angle_rms,angle_p99\n";
  const auto hits = [](const FrameErrors& e) {
    return fmt::format("{},{},{},{},{},{},{},{},{}", e.wrong_percent(), e.missed, e.false_hits, e.wrong_sheet, e.depth_rms, e.depth_p99, e.depth_max, e.normal_rms, e.normal_p99);
  };
  for (const CompareLine& line : report.measured.lines) {
    const CompareSetting& s = line.setting;
    const CompareVolume& v = report.subject->volumes[s.volume];
    const Spread ms = spread(line.frame_ms);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", s.spline, csv_text(v.name), lattice_name(v.volume.lattice), s.prefilter_text(), storage_name(s.storage),
                       s.intersect == Intersect::exact ? "exact" : "march", s.step, s.normal.normal == Normal::central ? "central" : s.normal.label(),
                       s.normal.normal == Normal::central ? s.normal.delta : 0.0, skip_label(s.skip), ms.median, ms.p5, ms.p95, line.coefficient_bytes, hits(line.reference), line.image_rmse, line.ssim);
    csv += line.truth ? "," + hits(*line.truth) : std::string(",,,,,,,,,");
    csv += line.volume ? fmt::format(",{},{},{},{},{}", line.volume->value_rmse, line.volume->value_max, line.volume->gradient_rmse, line.volume->angle_rms, line.volume->angle_p99)
                       : std::string(",,,,,");
    csv += "\n";
  }
  return csv;
}

Json compare_json(const CompareReport& report) {
  const Machine& machine = report.machine;
  Json json{{"measurement", "compare"}, {"command", report.command},      {"device", machine.device}, {"driver", machine.driver}, {"processor", machine.processor},
            {"cores", machine.cores},   {"subject", report.subject->name}, {"isovalue", report.subject->isovalue}, {"size", {report.plan.width, report.plan.height}},
            {"views", report.plan.views}, {"rounds", report.plan.rounds}, {"points", report.plan.points}, {"seed", report.plan.seed}, 
            {"error", report.metric->name}};
  for (const CompareMetric* metric : report.metrics()) json["errors"].push_back({{"name", metric->name}, {"title", metric->title}});
  for (const CompareVolume& v : report.subject->volumes)
    json["volumes"].push_back({{"name", v.name}, {"lattice", lattice_name(v.volume.lattice)}, {"dimensions", {v.volume.extents.x, v.volume.extents.y, v.volume.extents.z}},
                               {"samples", sample_count(v.volume)}, {"step", cell_length(v.volume.world)}});
  for (const CompareLine& line : report.measured.lines) {
    const CompareSetting& s = line.setting;
    const Spread ms = spread(line.frame_ms);
    Json entry{{"label", s.label(*report.subject)}, {"spline", s.spline}, {"volume", report.subject->volumes[s.volume].name}, {"prefilter", s.prefilter_text()}, {"storage", storage_name(s.storage)}, {"method", s.method()},
               {"normal", s.normal.label()}, {"skip", skip_label(s.skip)}, {"ms", {{"median", ms.median}, {"p5", ms.p5}, {"p95", ms.p95}}}, {"frame_ms", line.frame_ms},
               {"coefficient_bytes", line.coefficient_bytes}, {"reference", to_json(line.reference)}, {"image_rmse", line.image_rmse}, {"ssim", line.ssim}, {"left_out", line.left_out}};
    if (line.truth) entry["truth"] = to_json(*line.truth);
    if (line.volume) entry["reconstruction"] = to_json(*line.volume);
    for (const CompareMetric* metric : report.metrics()) entry["errors"][std::string(metric->name)] = metric->value(line).value();
    json["settings"].push_back(std::move(entry));
  }
  for (const CompareMetric* metric : report.metrics()) json["front"][std::string(metric->name)] = pareto_front(report.measured.lines, *metric);
  return json;
}

std::string compare_text(const CompareReport& report) {
  std::string text;
  for (const CompareSection& section : compare_sections(report)) text += fmt::format("{}\n\n{}\n{}\n\n", section.title, plain_text(section.table), section.caption);
  return text + fmt::format("{}; {}.\n", compare_caption(report), machine_text(report.machine));
}

std::string compare_markdown(const CompareReport& report) {
  std::string text = fmt::format("`{}`\n\n{}; {}.\n\n", report.command, compare_caption(report), machine_text(report.machine));
  for (const CompareSection& section : compare_sections(report)) text += fmt::format("### {}\n\n{}\n{}\n\n", section.title, markdown_text(section.table), section.caption);
  return text;
}

}  // namespace quincunx

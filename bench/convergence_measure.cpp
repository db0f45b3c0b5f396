#include "bench/convergence_measure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace quincunx {
namespace {

/// World units from the faces of the cube: on the coarsest grid far enough that the border changes nothing but a 2000th of an interpolation's part there.
constexpr double kOuterCells = 0.5;

/// Volume number 0 of a field_subject is Cartesian, number 1 BCC.
std::size_t volume_of(const Spline& spline) { return spline.lattice() == LatticeKind::cartesian ? 0 : 1; }

/// The Cartesian step with as many samples in a unit of volume.
double equal_step(const Volume& volume) {
  const double step = cell_length(volume.world);
  return volume.lattice == LatticeKind::cartesian ? step : step / bcc_step(Density::equal);
}

}  // namespace

double ConvergenceLine::order(double VolumeErrors::*member, std::size_t n) const {
  return std::log(errors[n - 1].*member / errors[n].*member) / std::log(steps[n - 1] / steps[n]);
}

int ConvergenceLine::gradient_order() const { return std::min(filter.order, space_order - 1); }

std::vector<ConvergenceLine> measure_convergence(const ConvergencePlan& plan, const Progress& progress) {
  std::vector<ConvergenceLine> lines;
  for (const std::string& name : plan.splines) {
    const auto spline = make_spline(name);
    for (const Spline::Filter& filter : spline->filters()) lines.push_back({name, filter, spline->filters().front().order, {}, {}});
  }
  const double all = double(plan.samples.size() * lines.size());
  double done = 0.0;
  for (const int samples : plan.samples) {
    CompareSubject subject = field_subject(make_field(plan.field), samples, {Density::equal});
    subject.border = kOuterCells / subject.cell;
    for (ConvergenceLine& line : lines) {
      report(progress, done++ / all);
      const auto spline = make_spline(line.spline);
      CompareSetting setting;
      setting.volume = volume_of(*spline);
      const Volume& volume = subject.volumes[setting.volume].volume;
      line.steps.push_back(equal_step(volume));
      line.errors.push_back(volume_errors(subject, setting, *spline, spline->coefficients(volume, line.filter.kind), plan.points, plan.seed));
    }
  }
  return lines;
}

Table convergence_table(const ConvergencePlan& plan, const std::vector<ConvergenceLine>& lines) {
  Table table{.headings = {"spline", "prefilter"}, .rows = {}, .left = 2};
  for (const char* what : {"value", "gradient"}) {
    for (const int samples : plan.samples) table.headings.push_back(fmt::format("{} {}^3", what, samples));
    table.headings.insert(table.headings.end(), {"order", "theory"});
  }
  for (const ConvergenceLine& line : lines) {
    std::vector<std::string> row{line.spline, std::string(prefilter_name(line.filter.kind))};
    const auto add = [&](double VolumeErrors::*member, int theory) {
      for (const VolumeErrors& e : line.errors) row.push_back(fmt::format("{:.2e}", e.*member));
      row.push_back(fmt::format("{:.2f}", line.order(member, line.errors.size() - 1)));
      row.push_back(fmt::format("{}", theory));
    };
    add(&VolumeErrors::value_rmse, line.filter.order);
    add(&VolumeErrors::gradient_rmse, line.gradient_order());
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string convergence_caption(const ConvergencePlan& plan) {
  return fmt::format(
      "{}, roots of the mean squares over {} random points of the cube [-0.5,0.5]^3 (seed {}); BCC volumes have as many samples as the Cartesian ones. order: between the last two spacings. theory: the order of "
      "the prefiltered spline, of gradients one less than that of its space.",
      plan.field, plan.points, plan.seed);
}

nlohmann::ordered_json convergence_json(const ConvergencePlan& plan, const std::vector<ConvergenceLine>& lines) {
  nlohmann::ordered_json json{{"measurement", "convergence"}, {"field", plan.field}, {"samples", plan.samples}, {"points", plan.points}, {"seed", plan.seed}};
  for (const ConvergenceLine& line : lines) {
    nlohmann::ordered_json row{{"spline", line.spline}, {"prefilter", prefilter_name(line.filter.kind)}, {"steps", line.steps}, {"order", line.filter.order}, {"gradient_order", line.gradient_order()}};
    for (const VolumeErrors& e : line.errors) row["value_rmse"].push_back(e.value_rmse), row["gradient_rmse"].push_back(e.gradient_rmse);
    json["splines"].push_back(std::move(row));
  }
  return json;
}

}  // namespace quincunx

#include "bench/stability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "app/flags.h"
#include "app/values.h"
#include "bench/output_folder.h"
#include "bench/skip_lists.h"
#include "bench/stability_report.h"
#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr const char* kIndexGroup = "index";
constexpr const char* kRootsGroup = "roots";
constexpr const char* kWatertightGroup = "watertight";

struct StabilityFlags {
  std::string folder, device;
  std::vector<std::string> groups = all_groups(), splines{polynomial_spline_names().begin(), polynomial_spline_names().end()};
  double step = 0.25;
  int points = 2000, polynomials = 100000, seed = 1;
  double rays = 1e6;
  bool markdown = false;
  Verbosity verbosity = Verbosity::normal;

  /// Those of the catalogue, and what is measured in other ways.
  static std::vector<std::string> all_groups() {
    std::vector<std::string> all(stability_groups().begin(), stability_groups().end());
    all.insert(all.end(), {kIndexGroup, kRootsGroup, kWatertightGroup});
    return all;
  }
  bool wants(const std::string& group) const { return std::find(groups.begin(), groups.end(), group) != groups.end(); }
  std::string command() const;
};

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ",")); }

/// The command line that makes the same again, without what only tells where it goes.
std::string StabilityFlags::command() const {
  std::string text = "quincunx stability";
  if (groups != all_groups()) text += " --groups " + joined(groups);
  if (splines.size() != polynomial_spline_names().size()) text += " --splines " + joined(splines);
  return text + fmt::format(" --step {} --points {} --polynomials {} --rays {:.0f} --seed {}", step, points, polynomials, rays, seed);
}

std::vector<std::string> parse_polynomial_splines(const std::string& text, const std::vector<std::string>& choices) {
  for (const std::string_view name : split_list(text))
    if (std::ranges::find(spline_names(), name) != spline_names().end() && !make_spline(name)->polynomial())
      throw InputError(fmt::format("--splines: found {}, whose pieces are no polynomials and have no first roots on a device, expected some of {}", name, joined(choices)));
  return parse_choices(text, "--splines", choices);
}

StabilityPlan cases_plan(const StabilityFlags& flags) {
  StabilityPlan plan{.cases = {}, .splines = flags.splines, .device = flags.device, .step = flags.step, .huge = flags.wants(kIndexGroup), .points = flags.points, .seed = std::uint32_t(flags.seed)};
  for (const std::string_view group : stability_groups()) {
    if (!flags.wants(std::string(group))) continue;
    const std::vector<StabilityCase> cases = stability_cases(group);
    plan.cases.insert(plan.cases.end(), cases.begin(), cases.end());
  }
  return plan;
}

StabilityReport measure(const StabilityFlags& flags, ProgressBar& bar) {
  StabilityReport report{.command = flags.command(), .machine = {}, .step = flags.step, .seed = std::uint32_t(flags.seed), .lines = {}, .roots = {}, .watertight = {}};
  std::string device;
  measure_stability(cases_plan(flags), report.lines, device, bar.stage("cases"));
  if (flags.wants(kRootsGroup)) {
    RootsPlan plan{.degrees = {}, .device = flags.device, .count = std::uint64_t(flags.polynomials), .seed = std::uint32_t(flags.seed)};
    for (const std::string& spline : flags.splines) plan.degrees.push_back(make_spline(spline)->degree());
    std::sort(plan.degrees.begin(), plan.degrees.end());
    plan.degrees.erase(std::unique(plan.degrees.begin(), plan.degrees.end()), plan.degrees.end());
    report.roots = measure_roots(plan, device, bar.stage("roots"));
  }
  if (flags.wants(kWatertightGroup))
    report.watertight = measure_watertight({.splines = flags.splines, .device = flags.device, .rays = std::uint64_t(flags.rays), .seed = std::uint32_t(flags.seed)}, device,
                                           bar.stage("watertight"));
  report.machine = this_machine(device);
  return report;
}

void stability(const StabilityFlags& flags) {
  refuse_reference(flags.device);
  std::optional<OutputFolder> folder;
  if (!flags.folder.empty()) {
    folder.emplace(flags.folder);
    folder->prepare({"stability.csv", "stability.json", "stability.html"});
  }
  ProgressBar bar(flags.verbosity);
  const StabilityReport report = measure(flags, bar);
  bar.erase();
  if (folder) {
    write_text(stability_csv(report), folder->file("stability.csv"));
    write_text(stability_json(report).dump(2) + "\n", folder->file("stability.json"));
    write_text(stability_html(report), folder->file("stability.html"));
  }
  if (flags.markdown) {
    fmt::print("{}", stability_markdown(report));
  } else {
    for (const StabilitySection& section : stability_sections(report)) fmt::print("{}\n\n{}\n{}\n\n", section.title, plain_text(section.table), section.caption);
    fmt::print("{}.\n", machine_text(report.machine));
  }
  const StabilityScore score = stability_score(report);
  if (score.passed < score.all) throw std::runtime_error(fmt::format("stability: {} of {} passed", score.passed, score.all));
  if (!flags.markdown) fmt::print("{} of {} passed\n", score.passed, score.all);
}

}  // namespace

Command stability_command(CLI::App& program) {
  auto flags = std::make_shared<StabilityFlags>();
  CLI::App* app = program.add_subcommand("stability", "Stiff and extreme cases, judged by the double-precision reference");
  app->footer(
      "Renders a catalogue of cases that arithmetic may get wrong, finds roots of polynomials that are known, and aims random rays at closed surfaces. First hits, values and normals are judged by\n"
      "bounds that follow from the arithmetic (docs/stability.md); beside them, what a fixed-step march makes of the same pixels. With -o, stability.csv, .json and .html are written to a folder.\n"
      "Exit status 1 where anything fails.");
  const std::vector<std::string> groups = StabilityFlags::all_groups();
  add_parsed(
      *app, "--groups", [flags, groups](const std::string& text) { flags->groups = parse_choices(text, "--groups", groups); }, "G[,G...]", joined(groups), "Parts to run");
  const std::vector<std::string> splines = flags->splines;
  add_parsed(
      *app, "--splines", [flags, splines](const std::string& text) { flags->splines = parse_polynomial_splines(text, splines); }, "S[,S...]", joined(splines), "Splines, each on its own lattice");
  add_number(*app, "--step", flags->step, {1e-3, 1e3}, "Of the march beside, in cells");
  add_integer(*app, "--points", flags->points, 1, 1000000, "Random points of each case where values and gradients are compared");
  add_integer(*app, "--polynomials", flags->polynomials, 1, 1000000000, "Of each kind and degree");
  add_number(*app, "--rays", flags->rays, {1.0, 1e12}, "Aimed inside, of each closed surface and spline");
  add_integer(*app, "--seed", flags->seed, 0, 1000000000, "Of points, polynomials and cameras");
  add_device(*app, flags->device);
  app->add_flag("--markdown", flags->markdown, "Print the tables as Markdown");
  app->add_option("-o,--output", flags->folder, "Folder to write to, made if it is not there")->type_name("DIR");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { stability(*flags); }};
}

}  // namespace quincunx

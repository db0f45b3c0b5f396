#include "bench/convergence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/flags.h"
#include "app/values.h"
#include "bench/convergence_measure.h"
#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

struct ConvergenceFlags {
  ConvergencePlan plan;
  std::string json;
  bool markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

std::vector<std::string> parse_splines(const std::string& text) {
  std::vector<std::string> splines;
  for (const std::string_view name : split_list(text)) splines.emplace_back(make_spline(name)->name());
  return splines;
}

std::vector<int> parse_samples(const std::string& text) {
  const std::vector<int> samples = parse_ascending(text, "--samples", 16, 512);
  if (samples.size() < 2) throw InputError(fmt::format("--samples: found {}, expected two or more", text));
  return samples;
}

void convergence(const ConvergenceFlags& flags) {
  if (!flags.json.empty()) check_writable(flags.json);
  ProgressBar bar(flags.verbosity);
  const std::vector<ConvergenceLine> lines = measure_convergence(flags.plan, bar.stage("convergence"));
  bar.erase();
  const Table table = convergence_table(flags.plan, lines);
  const std::string caption = convergence_caption(flags.plan);
  if (!flags.json.empty()) write_text(convergence_json(flags.plan, lines).dump(2) + "\n", flags.json);
  fmt::print("{}", flags.markdown ? markdown_text(table) + "\n" + caption + "\n" : caption + "\n\n" + plain_text(table));
}

}  // namespace

Command convergence_command(CLI::App& program) {
  auto flags = std::make_shared<ConvergenceFlags>();
  ConvergencePlan& plan = flags->plan;
  plan.splines.assign(spline_names().begin(), spline_names().end());
  CLI::App* app = program.add_subcommand("convergence", "How fast errors of values and gradients fall with the spacing");
  app->footer("In double precision, every prefilter of every spline, against an analytic field.");
  add_choice_name(*app, "--field", plan.field, {field_names().begin(), field_names().end()}, "The field");
  add_parsed(*app, "--splines", [&plan](const std::string& text) { plan.splines = parse_splines(text); }, "S[,S...]", "all", "Reconstructions");
  add_parsed(*app, "--samples", [&plan](const std::string& text) { plan.samples = parse_samples(text); }, "N[,N...]", fmt::format("{}", fmt::join(plan.samples, ",")),
             "Cartesian samples along an axis, ascending");
  add_integer(*app, "--points", plan.points, 1, 10000000, "Random points");
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { convergence(*flags); }};
}

}  // namespace quincunx

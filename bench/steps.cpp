#include "bench/steps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/flags.h"
#include "app/values.h"
#include "bench/steps_report.h"
#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

struct StepsFlags {
  StepsPlan plan;
  std::string json;
  bool markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

std::vector<double> parse_descending_steps(const std::string& text) {
  std::vector<double> steps;
  for (const double step : parse_numbers(text, "--steps")) {
    if (!(step >= 1e-3 && step <= 1e3)) throw InputError(fmt::format("--steps: found {}, expected numbers from 0.001 to 1000", step));
    if (!steps.empty() && step >= steps.back()) throw InputError(fmt::format("--steps: found {} after {}, expected descending ones", step, steps.back()));
    steps.push_back(step);
  }
  return steps;
}

void steps(const StepsFlags& flags) {
  if (!flags.json.empty()) check_writable(flags.json);
  ProgressBar bar(flags.verbosity);
  StepsReport report{.plan = flags.plan, .machine = {}, .lines = {}};
  std::string device;
  report.lines = measure_steps(flags.plan, device, bar.stage("steps"));
  report.machine = this_machine(device);
  bar.erase();

  const Table table = steps_table(report);
  const std::string caption = steps_caption(report);
  if (!flags.json.empty()) write_text(steps_json(report).dump(2) + "\n", flags.json);
  fmt::print("{}", flags.markdown ? markdown_text(table) + "\n" + caption + "\n" : caption + "\n\n" + plain_text(table));
}

}  // namespace

Command steps_command(CLI::App& program) {
  auto flags = std::make_shared<StepsFlags>();
  CLI::App* app = program.add_subcommand("steps", "Volume rendering against a closed form, by the length of steps");
  app->footer("Renders a ball whose opacity along every ray is known in closed form, by single samples (post) and pre-integrated stretches.");
  add_parsed(
      *app, "--splines", [flags](const std::string& text) { flags->plan.splines = parse_choices(text, "--splines", {spline_names().begin(), spline_names().end()}); }, "S[,S...]",
      fmt::format("{}", fmt::join(flags->plan.splines, ",")), "Reconstructions");
  add_parsed(
      *app, "--steps", [flags](const std::string& text) { flags->plan.steps = parse_descending_steps(text); }, "X[,X...]",
      fmt::format("{}", fmt::join(flags->plan.steps, ",")), "Lengths of a step in cells, descending");
  add_integer(*app, "--cells", flags->plan.cells, 8, 1024, "Cells along an axis");
  add_integer(*app, "--size", flags->plan.size, 1, 4096, "Pixels each way");
  add_integer(*app, "--repeat", flags->plan.rounds, 1, 100000, "Timed frames of each");
  add_device(*app, flags->plan.device);
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { steps(*flags); }};
}

}  // namespace quincunx

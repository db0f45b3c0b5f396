#include "bench/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "accel/structure.h"
#include "app/flags.h"
#include "app/render_report.h"
#include "app/values.h"
#include "bench/growth_report.h"
#include "bench/skip_lists.h"
#include "bench/sweep_measure.h"
#include "bench/views.h"
#include "io/atomic_file.h"
#include "lattice/error.h"
#include "lattice/field.h"

namespace quincunx {
namespace {

struct GrowthFlags {
  std::vector<std::string> fields{"marschner-lobb", "gyroid"};
  std::vector<int> sizes{64, 128, 256};
  SweepChoices choices{.labels = {skip_labels().begin(), skip_labels().end()}, .blocks = {8, 16}};
  int width = 512, height = 512, rounds = 3;
  std::string json, device;
  bool markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

/// One volume: all settings from one view. Adds to the lines of its field, `none` and then one a label.
void measure_volume(const GrowthFlags& flags, const Field& field, int size, std::span<GrowthLine> lines, std::string& device,
                    ProgressBar& bar) {
  const Volume volume = sample_field(field, LatticeKind::bcc, Extents(size), bar.stage("sampling"));
  const auto renderer = make_renderer(flags.device, volume, {});
  Renderer::Request request;
  request.scene.isosurfaces = {Isosurface{.isovalue = field.isovalue()}};
  request.scene.width = flags.width;
  request.scene.height = flags.height;
  SweepPlan plan{.settings = sweep_settings(flags.choices, {}), .views = orbit_views(request, volume, 1), .rounds = flags.rounds};
  plan.details = false;
  std::vector<SweepMeasurement> measured;
  measure_sweep(*renderer, plan, measured, bar.stage(fmt::format("{} {}", field.name(), size)));
  device = measured.front().scene.device;

  for (GrowthLine& line : lines) {
    double best = 0.0;
    int block = 0;
    for (std::size_t n = 0; n < measured.size(); ++n) {
      const SweepSetting& setting = plan.settings[n];
      const double ms = percentile(measured[n].cost.frame_ms, 0.5);
      if (setting.label() != line.label || (best > 0.0 && best <= ms)) continue;
      best = ms;
      block = setting.skips() ? setting.skip.block : 0;
    }
    line.frame_ms.push_back(best);
    line.block.push_back(block);
  }
}

GrowthReport measure(const GrowthFlags& flags, ProgressBar& bar) {
  GrowthReport report{.sizes = flags.sizes,
                      .blocks = flags.choices.blocks,
                      .width = flags.width,
                      .height = flags.height,
                      .rounds = flags.rounds,
                      .machine = {},
                      .lines = {}};
  std::vector<std::string> labels = flags.choices.labels;
  if (std::find(labels.begin(), labels.end(), "none") == labels.end()) labels.insert(labels.begin(), "none");
  std::string device;
  for (const std::string& name : flags.fields) {
    const auto field = make_field(name);
    const std::size_t first = report.lines.size();
    for (const std::string& label : labels) report.lines.push_back({name, label, {}, {}});
    for (const int size : flags.sizes)
      measure_volume(flags, *field, size, std::span(report.lines).subspan(first), device, bar);
  }
  report.machine = this_machine(device);
  return report;
}

void growth(const GrowthFlags& flags) {
  refuse_reference(flags.device);
  if (!flags.json.empty()) check_writable(flags.json);
  ProgressBar bar(flags.verbosity);
  const GrowthReport report = measure(flags, bar);
  bar.erase();

  const Table table = growth_table(report);
  const std::string caption = growth_caption(report);
  if (!flags.json.empty()) write_text(growth_json(report).dump(2) + "\n", flags.json);
  fmt::print("{}", flags.markdown ? markdown_text(table) + "\n" + caption + "\n" : caption + "\n\n" + plain_text(table));
}

}  // namespace

Command growth_command(CLI::App& program) {
  auto flags = std::make_shared<GrowthFlags>();
  CLI::App* app = program.add_subcommand("growth", "How frame times grow with the volume, for every way to skip");
  app->footer("Samples each field on BCC lattices of growing size, so that the object stays, and renders it from one view.");
  add_parsed(
      *app, "--fields", [flags](const std::string& text) { flags->fields = parse_choices(text, "--fields", {field_names().begin(), field_names().end()}); }, "F[,F...]",
      "marschner-lobb,gyroid", "Objects, those of `quincunx sample`, at their isovalues");
  add_parsed(
      *app, "--sizes", [flags](const std::string& text) { flags->sizes = parse_ascending(text, "--sizes", 2, 1024); }, "N[,N...]", "64,128,256",
      "Samples per axis of each coset, ascending");
  add_structures(*app, flags->choices.labels);
  add_blocks(*app, "--block", flags->choices.blocks);
  add_size(*app, flags->width, flags->height);
  add_integer(*app, "--repeat", flags->rounds, 1, 100000, "Timed frames of each setting");
  add_device(*app, flags->device);
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { growth(*flags); }};
}

}  // namespace quincunx

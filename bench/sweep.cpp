#include "bench/sweep.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "accel/structure.h"
#include "app/flags.h"
#include "app/render_flags.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "bench/gnuplot.h"
#include "bench/output_folder.h"
#include "bench/skip_lists.h"
#include "bench/sweep_plot.h"
#include "bench/sweep_report.h"
#include "bench/views.h"
#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

struct SweepFlags {
  std::string volume, folder, device;
  RenderFlags scene;  ///< isovalues, size, intersection
  SweepChoices choices{.labels = {skip_labels().begin(), skip_labels().end()}};
  int views = 8, rounds = 1;
  bool json = false;
  Verbosity verbosity = Verbosity::normal;
};

/// Ctrl-C after some settings were measured and written.
class InterruptedSweep final : public Interrupted {
 public:
  InterruptedSweep(std::size_t measured, std::size_t planned)
      : text_(fmt::format("interrupted: {} of {} settings measured", measured, planned)) {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// Far enough that blocks may change, near enough that their number hardly does: a thousandth of the samples' range.
double moved_isovalue(const SampleRange& range) {
  const double width = range.max - range.min;
  return 1e-3 * (width > 0.0 ? width : std::max(std::abs(range.max), 1.0));
}

/// Measures into `report.measured`; false where it was interrupted after some.
bool measure(const SweepFlags& flags, const Volume& volume, Renderer& renderer, SweepReport& report, ProgressBar& bar) {
  Renderer::Request request;
  request.scene = flags.scene.scene;
  request.scene.isosurfaces = make_isosurfaces(flags.scene);
  SweepPlan plan{.settings = {}, .views = orbit_views(request, volume, flags.views), .rounds = flags.rounds};
  plan.moved_isovalue = moved_isovalue(sample_range(volume));
  plan.settings = sweep_settings(flags.choices, chosen_skip(renderer, plan.views.front(), bar.stage("preparing")));
  report.settings = plan.settings;
  try {
    measure_sweep(renderer, plan, report.measured, bar.stage("sweeping"));
  } catch (const Interrupted&) {
    if (report.measured.empty()) throw;
    return false;
  }
  return true;
}

void write_plot(const SweepReport& report, const std::string& path) {
  const Drawn drawn = draw_with_gnuplot(sweep_plot_script(report), path);
  if (drawn == Drawn::yes) return;
  std::filesystem::remove(path);  // that of an earlier sweep would be taken for this one's
  fmt::print(stderr, "note: {} is not drawn: {}\n", path,
             drawn == Drawn::failed ? "gnuplot failed" : "gnuplot is not there (Debian package gnuplot-nox)");
}

void write_outputs(const SweepReport& report, const OutputFolder& folder) {
  write_text(sweep_csv(report), folder.file("sweep.csv"));
  write_text(sweep_json(report).dump(2) + "\n", folder.file("sweep.json"));
  write_text(sweep_markdown(report), folder.file("sweep.md"));
  write_plot(report, folder.file("sweep.svg"));
}

void sweep(const SweepFlags& flags) {
  refuse_reference(flags.device);
  OutputFolder folder(flags.folder);
  ProgressBar bar(flags.verbosity);
  const Volume volume = read_bcc_volume(flags.volume, bar.stage("reading"));
  const auto renderer = make_renderer(flags.device, volume, {});
  folder.prepare({"sweep.csv", "sweep.json", "sweep.md", "sweep.svg"});

  const Scene& scene = flags.scene.scene;
  SweepReport report{.volume = flags.volume,
                     .isovalues = flags.scene.isovalues,
                     .width = scene.width,
                     .height = scene.height,
                     .views = flags.views,
                     .rounds = flags.rounds,
                     .intersect = scene.intersect,
                     .step = scene.step,
                     .choices = flags.choices,
                     .machine = {},
                     .settings = {},
                     .measured = {}};
  const bool complete = measure(flags, volume, *renderer, report, bar);
  report.machine = this_machine(report.measured.front().scene.device);
  bar.erase();

  write_outputs(report, folder);
  if (flags.json) {
    fmt::print("{}\n", sweep_json(report).dump(2));
  } else if (flags.verbosity == Verbosity::normal) {
    fmt::print("{}", sweep_text(report));
  }
  if (!complete) throw InterruptedSweep(report.measured.size(), report.settings.size());
}

void add_scene_flags(CLI::App& app, RenderFlags& flags) {
  add_parsed(
      app, "--iso", [&flags](const std::string& text) { flags.isovalues = parse_numbers(text, "--iso"); }, "V[,V...]", "",
      "Isovalues; several are rendered see-through as `quincunx render` does")
      ->required();
  add_size(app, flags.scene.width, flags.scene.height);
  add_choice(app, "--intersect", flags.scene.intersect, {{"exact", Intersect::exact}, {"march", Intersect::march}},
             "First root of the polynomial pieces, or fixed steps");
  add_number(app, "--step", flags.scene.step, {1e-3, 1e3}, "Of march, in cells");
}

}  // namespace

Command sweep_command(CLI::App& program) {
  auto flags = std::make_shared<SweepFlags>();
  CLI::App* app = program.add_subcommand("sweep", "Compare the ways to skip empty space on a volume");
  app->footer(
      "Measures every structure with every block size, none, and what --skip auto chooses: frames in turns, stages, bytes,\n"
      "counts. Writes sweep.csv, sweep.json, sweep.md and, with gnuplot, sweep.svg to a folder. Ctrl-C keeps what was measured.");
  app->add_option("VOLUME", flags->volume, "NRRD file of a BCC volume")->required();
  add_scene_flags(*app, flags->scene);
  add_structures(*app, flags->choices.labels);
  add_blocks(*app, "--blocks", flags->choices.blocks);
  add_choice(*app, "--cell-test", flags->choices.cell_tests,
             {{"on", CellTests::on}, {"off", CellTests::off}, {"both", CellTests::both}}, "Test single cells too");
  add_integer(*app, "--orbit", flags->views, 1, 1000, "Views, their azimuths equally apart");
  add_integer(*app, "--repeat", flags->rounds, 1, 100000, "Rounds: timed frames of each setting and view");
  add_device(*app, flags->device);
  app->add_flag("--json", flags->json, "Print JSON instead of the tables");
  app->add_option("-o,--output", flags->folder, "Folder to write to; made if it is not there")->type_name("DIR")->required();
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { sweep(*flags); }};
}

}  // namespace quincunx

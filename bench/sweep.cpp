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
#include "app/nan_flag.h"
#include "app/render_flags.h"
#include "app/spline_flags.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "bench/gnuplot.h"
#include "bench/output_folder.h"
#include "bench/skip_lists.h"
#include "bench/sweep_bricks.h"
#include "bench/sweep_plot.h"
#include "bench/sweep_preset.h"
#include "bench/sweep_report.h"
#include "bench/views.h"
#include "io/atomic_file.h"
#include "lattice/error.h"
#include "render/coefficient_texels.h"

namespace quincunx {
namespace {

struct SweepFlags {
  std::vector<std::string> volumes;  ///< one, but with a preset
  std::string folder, device;
  PresetFlags preset;
  RenderFlags scene;  ///< isovalues, transfer function, size, intersection, spline
  SweepChoices choices{.labels = {skip_labels().begin(), skip_labels().end()}};
  std::vector<int> bricks;  ///< edges, ascending
  std::uint64_t pool_bytes = BricksPlan{}.pool_bytes;
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
double moved_by(const SampleRange& range) {
  const double width = range.max - range.min;
  return 1e-3 * (width > 0.0 ? width : std::max(std::abs(range.max), 1.0));
}

/// Measures into `report.measured` and `report.bricks`; false where it was interrupted after some.
bool measure(const SweepFlags& flags, const Scene& scene, const Volume& volume, Renderer& renderer, SweepReport& report, ProgressBar& bar) {
  Renderer::Request request;
  request.scene = scene;
  SweepPlan plan{.settings = {}, .views = orbit_views(request, volume, flags.views), .rounds = flags.rounds};
  plan.moved = moved_by(sample_range(volume));
  const SkipConfig chosen = chosen_skip(renderer, plan.views.front(), bar.stage("preparing"));
  plan.settings = sweep_settings(flags.choices, chosen);
  report.settings = plan.settings;
  const BricksPlan bricks{.bricks = flags.bricks, .pool_bytes = flags.pool_bytes, .device = flags.device, .config = flags.scene.config,
                          .skip = chosen, .views = plan.views, .rounds = flags.rounds};
  check_bricks(bricks, volume);
  try {
    measure_sweep(renderer, plan, report.measured, bar.stage("sweeping"));
    if (flags.bricks.empty()) return true;
    report.bricks = measure_bricks(bricks, volume, renderer, bar.stage("bricks"));
  } catch (const Interrupted&) {
    if (report.measured.empty()) throw;
    return false;
  }
  return true;
}

void write_outputs(const SweepReport& report, const OutputFolder& folder) {
  write_text(sweep_csv(report), folder.file("sweep.csv"));
  write_text(sweep_json(report).dump(2) + "\n", folder.file("sweep.json"));
  write_text(sweep_markdown(report), folder.file("sweep.md"));
  draw_or_note(sweep_plot_script(report), folder.file("sweep.svg"));
}

void check_sweep_flags(const SweepFlags& flags) {
  check_something_is_seen(flags.scene);
  refuse_reference(flags.device);
  check_storage(flags.scene.config.storage, flags.scene.config.precision);
  if (flags.bricks.empty()) return;
  if (flags.scene.config.storage != Storage::float32)
    throw InputError(fmt::format("--bricks: found --storage {}, expected float32: each brick would have a unit of its own, and its picture would not be the whole volume's",
                                 storage_name(flags.scene.config.storage)));
  if (flags.scene.config.precision == Precision::float64)
    throw InputError("--bricks: found --precision double, expected --precision float: bricks hold 32-bit floats");
  if (!flags.scene.isovalues.empty() && flags.scene.intersect == Intersect::march)
    throw InputError("--bricks: found --intersect march, expected --intersect exact");
}

void sweep_one_volume(const SweepFlags& flags) {
  if (flags.volumes.size() != 1)
    throw InputError(fmt::format("VOLUME: found {} file{}, expected one, or --preset", flags.volumes.size(), flags.volumes.size() == 1 ? "" : "s"));
  check_sweep_flags(flags);
  OutputFolder folder(flags.folder);
  ProgressBar bar(flags.verbosity);
  const Scene scene = make_scene(flags.scene);
  const Volume volume = read_finite_volume(flags.volumes.front(), bar.stage("reading"), flags.scene.config.nan);
  const auto renderer = make_renderer(flags.device, volume, flags.scene.config);
  folder.prepare({"sweep.csv", "sweep.json", "sweep.md", "sweep.svg"});

  SweepReport report{.volume = flags.volumes.front(),
                     .spline = flags.scene.config.spline.empty() ? std::string(default_spline(volume.lattice)) : flags.scene.config.spline,
                     .isovalues = flags.scene.isovalues,
                     .transfer_function = flags.scene.look.transfer_function,
                     .look = scene.volume,
                     .width = scene.width,
                     .height = scene.height,
                     .views = flags.views,
                     .rounds = flags.rounds,
                     .intersect = scene.intersect,
                     .step = scene.step,
                     .precision = flags.scene.config.precision,
                     .storage = flags.scene.config.storage,
                     .choices = flags.choices,
                     .machine = {},
                     .settings = {},
                     .measured = {},
                     .bricks = {}};
  const bool complete = measure(flags, scene, volume, *renderer, report, bar);
  report.machine = this_machine(report.measured.front().scene.device);
  bar.erase();

  write_outputs(report, folder);
  if (flags.json) {
    fmt::print("{}\n", sweep_json(report).dump(2));
  } else if (flags.verbosity == Verbosity::normal) {
    fmt::print("{}", sweep_text(report));
  }
  if (!complete) throw InterruptedSweep(report.measured.size(), report.settings.size());
  if (!report.differing().empty()) throw std::runtime_error(sweep_pictures(report));
}

void sweep(const CLI::App& app, const SweepFlags& flags) {
  if (flags.preset.list) return list_presets();
  check_preset_flags(app, flags.preset);
  if (flags.folder.empty()) throw InputError("--output: found none, expected a folder to write to");
  if (flags.preset.name.empty()) return sweep_one_volume(flags);
  refuse_reference(flags.device);
  const PresetWishes wishes{.volumes = flags.volumes,
                            .thresholds = flags.scene.isovalues,
                            .spline = flags.scene.config.spline,
                            .device = flags.device,
                            .size = flags.preset.full ? PresetSize::full() : PresetSize{},
                            .labels = {skip_labels().begin(), skip_labels().end()}};
  sweep_preset(flags.preset, wishes, flags.folder, flags.json, flags.verbosity);
}

void add_scene_flags(CLI::App& app, RenderFlags& flags) {
  add_isovalues(app, flags)->description("Isovalues; several are rendered see-through as `quincunx render` does");
  add_size(app, flags.scene.width, flags.scene.height);
  add_intersect(app, flags);
  add_step(app, flags);
  add_spline(app, flags.config.spline);
  add_prefilter(app, flags.config.prefilter);
  add_nan(app, flags.config.nan);
  add_precision(app, flags);
  add_storage(app, flags.config.storage);
  add_volume_flags(app, flags.look);
}

void add_brick_flags(CLI::App& app, SweepFlags& flags) {
  const auto bricks = [&flags](const std::string& text) { flags.bricks = parse_bricks(text); };
  add_parsed(app, "--bricks", bricks, "N[,N...]", "", "Also brick pools with bricks of these edges in cells, powers of two from 4 to 256");
  const auto pool = [&flags](const std::string& text) { flags.pool_bytes = parse_bytes(text, "--pool"); };
  add_parsed(app, "--pool", pool, "BYTES", "1G", "Size of each of these pools, at most");
}

}  // namespace

Command sweep_command(CLI::App& program) {
  auto flags = std::make_shared<SweepFlags>();
  CLI::App* app = program.add_subcommand("sweep", "Compare the ways to skip empty space on a volume");
  app->footer(
      "Measures every structure with every block size, none, and what --skip auto chooses: frames in turns, stages, bytes,\n"
      "counts; and compares their pictures, bit for bit. Writes sweep.csv, sweep.json, sweep.md and, with gnuplot, sweep.svg to a folder. Ctrl-C keeps what was measured.\n"
      "--preset makes a published experiment again and writes NAME.csv, NAME.json, NAME.md and NAME.svg; --list-presets says which there are.");
  app->add_option("VOLUME", flags->volumes, "NRRD file of a volume; of several with --preset");
  add_scene_flags(*app, flags->scene);
  add_structures(*app, flags->choices.labels);
  add_blocks(*app, "--blocks", flags->choices.blocks);
  add_choice(*app, "--cell-test", flags->choices.cell_tests,
             {{"on", CellTests::on}, {"off", CellTests::off}, {"both", CellTests::both}}, "Test single cells too");
  add_brick_flags(*app, *flags);
  add_integer(*app, "--orbit", flags->views, 1, 1000, "Views, their azimuths equally apart");
  add_integer(*app, "--repeat", flags->rounds, 1, 100000, "Rounds: timed frames of each setting and view");
  add_device(*app, flags->device);
  app->add_flag("--json", flags->json, "Print JSON instead of the tables");
  app->add_option("-o,--output", flags->folder, "Folder to write to; made if it is not there")->type_name("DIR");
  add_preset_flags(*app, flags->preset);
  add_quiet(*app, flags->verbosity);
  return {app, [flags, app] { sweep(*app, *flags); }};
}

}  // namespace quincunx

#include "bench/precision.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <limits>
#include <memory>

#include "app/flags.h"
#include "app/volume_input.h"
#include "bench/precision_report.h"
#include "bench/skip_lists.h"
#include "bench/truth.h"
#include "bench/views.h"
#include "io/atomic_file.h"

namespace quincunx {
namespace {

constexpr std::array kPrecisions{Precision::float32, Precision::float64};

struct PrecisionFlags {
  std::string volume, json, device;
  double isovalue = 0.0;
  int width = 512, height = 512, views = 3, rounds = 3;
  bool markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

/// The renderers of both precisions, float first.
using Both = std::array<std::unique_ptr<Renderer>, 2>;

Both make_both(const PrecisionFlags& flags, const Volume& volume) {
  Both both;
  for (std::size_t n = 0; n < both.size(); ++n) {
    Renderer::Config config;
    config.precision = kPrecisions[n];
    both[n] = make_renderer(flags.device, volume, config);
  }
  return both;
}

/// One untimed frame of a view, which also compiles: errors, counts and bytes.
void look_at(PrecisionLine& line, Renderer& renderer, const Renderer::Request& view, const Truth& truth, const Frame& expected, HitComparison& comparison,
             std::string& device) {
  RenderStats stats;
  const Frame frame = renderer.render(view, stats);
  comparison.add(truth, view.scene, frame, expected);
  line.cost.rays += stats.rays;
  line.cost.hits += stats.hits;
  line.device_bytes = 0;
  for (const auto& [purpose, bytes] : stats.device_bytes) {
    line.device_bytes += bytes;
    if (purpose == "coefficients") line.coefficient_bytes = bytes;
  }
  device = stats.device;
}

PrecisionReport measure(const PrecisionFlags& flags, ProgressBar& bar) {
  const Volume volume = read_bcc_volume(flags.volume, bar.stage("reading"));
  Renderer::Request request;
  request.scene.isosurfaces = {Isosurface{.isovalue = flags.isovalue}};
  request.scene.width = flags.width;
  request.scene.height = flags.height;
  const std::vector<Renderer::Request> views = orbit_views(request, volume, flags.views);
  const Both renderers = make_both(flags, volume);
  const Truth truth(volume, bar.stage("preparing"));

  PrecisionReport result{.width = flags.width, .height = flags.height, .views = flags.views, .rounds = flags.rounds, .machine = {}, .lines = {}};
  for (const Precision precision : kPrecisions)
    result.lines.push_back({.volume = flags.volume, .isovalue = flags.isovalue, .precision = precision, .cost = {}, .errors = {}});
  std::array<HitComparison, 2> comparisons;
  std::string device;
  const Progress progress = bar.stage("looking");
  for (std::size_t view = 0; view < views.size(); ++view) {
    const Frame expected = truth.frame(views[view].scene);
    for (std::size_t n = 0; n < renderers.size(); ++n) look_at(result.lines[n], *renderers[n], views[view], truth, expected, comparisons[n], device);
    report(progress, double(view + 1) / double(views.size()));
  }

  // Frames in turns: of each round and view float, then double.
  const Progress timing = bar.stage("timing");
  for (int round = 0; round < flags.rounds; ++round)
    for (std::size_t view = 0; view < views.size(); ++view) {
      for (std::size_t n = 0; n < renderers.size(); ++n) {
        RenderStats stats;
        renderers[n]->render(views[view], stats);
        result.lines[n].cost.frame_ms.push_back(stats.trace_ms.front());
      }
      report(timing, (round + double(view + 1) / double(views.size())) / flags.rounds);
    }
  for (std::size_t n = 0; n < renderers.size(); ++n) result.lines[n].errors = comparisons[n].errors();
  result.machine = this_machine(device);
  return result;
}

void precision(const PrecisionFlags& flags) {
  refuse_reference(flags.device);
  if (!flags.json.empty()) check_writable(flags.json);
  ProgressBar bar(flags.verbosity);
  const PrecisionReport result = measure(flags, bar);
  bar.erase();

  const Table table = precision_table(result);
  const std::string caption = precision_caption(result);
  if (!flags.json.empty()) write_text(precision_json(result).dump(2) + "\n", flags.json);
  fmt::print("{}", flags.markdown ? markdown_text(table) + "\n" + caption + "\n" : caption + "\n\n" + plain_text(table));
}

}  // namespace

Command precision_command(CLI::App& program) {
  auto flags = std::make_shared<PrecisionFlags>();
  CLI::App* app = program.add_subcommand("precision", "First hits in 32-bit and 64-bit floats: their error against their time");
  app->footer(
      "Renders exact first hits with --precision float and double, frame by frame in turns, as --skip auto skips. times float: of frames\n"
      "of one round and view. Errors are against the double-precision reference, depth in cells, normals in degrees.");
  app->add_option("VOLUME", flags->volume, "NRRD file of a BCC volume")->required();
  constexpr double inf = std::numeric_limits<double>::infinity();
  add_number(*app, "--iso", flags->isovalue, {-inf, inf}, "Isovalue")->default_str("")->required();
  add_size(*app, flags->width, flags->height);
  add_integer(*app, "--views", flags->views, 1, 1000, "Views of the orbit, their azimuths equally apart");
  add_integer(*app, "--repeat", flags->rounds, 1, 100000, "Timed frames of each precision and view, after an untimed one");
  add_device(*app, flags->device);
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { precision(*flags); }};
}

}  // namespace quincunx

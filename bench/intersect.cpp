#include "bench/intersect.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <set>

#include "app/flags.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "bench/intersect_report.h"
#include "bench/views.h"
#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

struct IntersectFlags {
  std::string volume, folder, json, device;
  double isovalue = 0.0;
  int width = 512, height = 512, views = 3, rounds = 3;
  int block = 16;
  std::vector<double> steps{0.5, 0.25, 0.125};
  bool errors = true, markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

std::vector<double> parse_different_steps(const std::string& text) {
  const std::vector<double> steps = parse_numbers(text, "--steps");
  std::set<double> seen;
  for (const double step : steps) {
    if (!(step >= 1e-3 && step <= 1e3))
      throw InputError(fmt::format("--steps: found {}, expected numbers from 0.001 to 1000", step));
    if (!seen.insert(step).second)
      throw InputError(fmt::format("--steps: found {} twice, expected different ones", step));
  }
  return steps;
}

/// The files to write: path and whether it is JSON.
struct Outputs {
  std::vector<std::string> json;
  std::string markdown;
};

/// Throws InputError where one of them cannot be written.
Outputs outputs(const IntersectFlags& flags) {
  Outputs files;
  if (!flags.json.empty()) files.json.push_back(flags.json);
  if (!flags.folder.empty()) {
    files.json.push_back((std::filesystem::path(flags.folder) / "intersect.json").string());
    files.markdown = (std::filesystem::path(flags.folder) / "intersect.md").string();
    check_writable(files.markdown);
  }
  for (const std::string& path : files.json) check_writable(path);
  return files;
}

Renderer::Request request(const IntersectFlags& flags) {
  Renderer::Request request;
  request.scene.isosurfaces = {Isosurface{.isovalue = flags.isovalue}};
  request.scene.width = flags.width;
  request.scene.height = flags.height;
  request.skip.block = flags.block;
  return request;
}

/// The reference's picture of each view.
std::vector<Frame> reference_frames(const Truth& truth, const std::vector<Renderer::Request>& views,
                                    const Progress& progress) {
  std::vector<Frame> frames;
  for (const Renderer::Request& view : views) {
    const double done = double(frames.size()), all = double(views.size());
    frames.push_back(truth.frame(view.scene, [&](double fraction) { report(progress, (done + fraction) / all); }));
  }
  return frames;
}

IntersectReport measure(const IntersectFlags& flags, ProgressBar& bar) {
  const Volume volume = read_bcc_volume(flags.volume, bar.stage("reading"));
  const TimingPlan plan{intersect_settings(flags.steps), orbit_views(request(flags), volume, flags.views), flags.rounds};
  const auto renderer = make_renderer(flags.device, volume, {});

  std::unique_ptr<Truth> truth;
  std::vector<Frame> expected;
  if (flags.errors) {
    truth = std::make_unique<Truth>(volume, bar.stage("preparing"));
    expected = reference_frames(*truth, plan.views, bar.stage("reference"));
  }
  std::vector<HitComparison> comparisons(plan.settings.size());
  const auto compare = [&](std::size_t setting, std::size_t view, const Frame& frame) {
    if (truth) comparisons[setting].add(*truth, plan.views[view].scene, frame, expected[view]);
  };

  IntersectReport result{.volume = flags.volume,
                         .isovalue = flags.isovalue,
                         .width = flags.width,
                         .height = flags.height,
                         .views = flags.views,
                         .rounds = flags.rounds,
                         .block = flags.block,
                         .machine = {},
                         .settings = plan.settings,
                         .costs = {},
                         .errors = {}};
  std::string device;
  result.costs = time_in_turns(*renderer, plan, compare, device, bar.stage("timing"));
  result.machine = this_machine(device);
  for (const HitComparison& comparison : comparisons) {
    if (truth) result.errors.push_back(comparison.errors());
  }
  return result;
}

void intersect(const IntersectFlags& flags) {
  const Outputs files = outputs(flags);
  ProgressBar bar(flags.verbosity);
  const IntersectReport result = measure(flags, bar);
  bar.erase();

  const Table table = intersect_table(result);
  const std::string caption = intersect_caption(result), markdown = markdown_text(table) + "\n" + caption + "\n";
  const std::string json = intersect_json(result).dump(2) + "\n";
  for (const std::string& path : files.json) write_text(json, path);
  if (!files.markdown.empty()) write_text(markdown, files.markdown);
  fmt::print("{}", flags.markdown ? markdown : caption + "\n\n" + plain_text(table));
}

}  // namespace

Command intersect_command(CLI::App& program) {
  auto flags = std::make_shared<IntersectFlags>();
  CLI::App* app = program.add_subcommand("intersect", "Ways to find the first hit: their error against their time");
  app->footer(
      "Compares exact and march at every step, each with --skip grid and none, frame by frame in turns.\n"
      "speed-up: over march 0.25 with none, the published method. evaluations/ray: of polynomial pieces for exact, of\n"
      "samples for march. Errors are against the double-precision reference: missed and false first hits, hits on\n"
      "another sheet (more than half a cell away), depth in cells, normals in degrees, |f - isovalue| / |grad f| in "
      "cells.");
  app->add_option("VOLUME", flags->volume, "NRRD file of a BCC volume")->required();
  constexpr double inf = std::numeric_limits<double>::infinity();
  add_number(*app, "--iso", flags->isovalue, {-inf, inf}, "Isovalue")->default_str("")->required();
  add_size(*app, flags->width, flags->height);
  add_integer(*app, "--views", flags->views, 1, 1000, "Views of the orbit, their azimuths equally apart");
  add_integer(*app, "--repeat", flags->rounds, 1, 100000,
              "Timed frames of each setting and view, after an untimed one");
  add_parsed(
      *app, "--steps", [flags](const std::string& text) { flags->steps = parse_different_steps(text); }, "S[,S...]",
      "0.5,0.25,0.125", "Of march, in cells; 0.25 with none is measured in any case");
  add_block(*app, flags->block);
  add_device(*app, flags->device);
  app->add_flag_callback(
      "--no-error", [flags] { flags->errors = false; }, "Time alone: no reference is rendered");
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  app->add_option("-o,--output", flags->folder, "Folder, which is there, to write intersect.json and intersect.md to")
      ->type_name("DIR");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { intersect(*flags); }};
}

}  // namespace quincunx

// After M. Kinkelin, "GPU Volume Raycasting using Bounding Interval Hierarchies", student project, TU Wien 2009, who compares the memory, the pictures and the
// speed of his voxels with those of a grid in a 3D texture.
#include "bench/voxels.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/flags.h"
#include "app/render_flags.h"
#include "app/render_report.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "app/voxel_input.h"
#include "bench/frame_error.h"
#include "bench/machine.h"
#include "bench/skip_lists.h"
#include "bench/table.h"
#include "bench/views.h"
#include "io/atomic_file.h"
#include "lattice/error.h"
#include "render/voxel_renderer.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

struct VoxelsFlags {
  RenderFlags scene;  ///< volume, transfer function, size, device
  std::vector<double> factors{1.0, 1.5, 2.0}, deviations;
  int views = 3, rounds = 3;
  std::string json;
  bool markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

/// One way to see the volume.
struct Line {
  std::string way;
  std::optional<double> factor, deviation;
  std::optional<VoxelStats> voxels;
  std::uint64_t bytes = 0, grid_bytes = 0;  ///< on the device for what is seen of the volume; samples of the volume as they are in the file
  double made_ms = 0.0;                     ///< once: prefilter, or resampling, voxels and tree
  std::vector<double> frame_ms;
  double square = 0.0;  ///< sum over the views of squared image_rmse
};

/// Untimed frames of all views, which are compared, then timed ones.
void look(Renderer& renderer, const VoxelsFlags& flags, std::span<const Renderer::Request> views, std::vector<Frame>& truth, Line& line, std::string& device, const Progress& progress) {
  const bool is_truth = truth.empty();
  for (const Renderer::Request& view : views) {
    RenderStats stats;
    Frame frame = renderer.render(view, stats, progress);
    if (line.made_ms == 0.0) line.made_ms = stats.prefilter_ms + stats.bounds_ms + stats.build_ms;
    if (stats.voxels) line.voxels = stats.voxels;
    for (const auto& [purpose, bytes] : stats.device_bytes)
      if (purpose == "coefficients") line.bytes = bytes;
    device = stats.device;
    if (is_truth) {
      truth.push_back(std::move(frame));
      continue;
    }
    line.square += std::pow(image_rmse(frame, truth[std::size_t(&view - views.data())]), 2.0);
  }
  if (line.voxels) line.bytes = line.voxels->leaf_bytes + line.voxels->place_bytes + line.voxels->node_bytes;
  for (int round = 0; round < flags.rounds; ++round)
    for (const Renderer::Request& view : views) {
      RenderStats stats;
      renderer.render(view, stats, progress);
      line.frame_ms.push_back(stats.trace_ms.front());
    }
}

std::vector<Line> measure(const VoxelsFlags& flags, ProgressBar& bar, std::string& device) {
  const Volume volume = read_finite_volume(flags.scene.volume, bar.stage("reading"), {});
  const std::uint64_t grid_bytes = std::uint64_t(volume.sample_count()) * sample_type_bytes(volume.type());
  Renderer::Request request;
  request.scene = make_scene(flags.scene);
  std::vector<Line> lines;
  std::vector<Frame> truth;

  const bool bcc = volume.lattice == LatticeKind::bcc;
  struct Ordinary {
    const char* spline;
    double step;
  };
  for (const Ordinary& o : {Ordinary{bcc ? "bcc7" : "tricubic", 0.25}, {bcc ? "bcc4" : "trilinear", 0.25}, {bcc ? "bcc4" : "trilinear", 1.0}}) {
    Line line{.way = fmt::format("{}, steps of {}", o.spline, o.step), .factor = {}, .deviation = {}, .voxels = {}, .grid_bytes = grid_bytes, .frame_ms = {}};
    Renderer::Config config;
    config.spline = o.spline;
    request.scene.volume->step = o.step;
    const auto renderer = make_renderer(flags.scene.device, volume, config);
    look(*renderer, flags, orbit_views(request, volume, flags.views), truth, line, device, bar.stage(line.way));
    lines.push_back(std::move(line));
  }
  std::vector<std::optional<double>> deviations{std::nullopt};
  deviations.insert(deviations.end(), flags.deviations.begin(), flags.deviations.end());
  for (const double factor : flags.factors)
    for (const std::optional<double>& deviation : deviations) {
      Line line{.way = "voxels", .factor = factor, .deviation = deviation, .voxels = {}, .grid_bytes = grid_bytes, .frame_ms = {}};
      RenderFlags wanted = flags.scene;
      wanted.voxel.way = RenderWay::bih;
      wanted.voxel.supersample = factor;
      wanted.voxel.deviation = deviation;
      VoxelInput input = read_voxels(wanted, bar);
      const double made = input.resample_ms + input.voxels_ms;
      const auto renderer = make_voxel_renderer(flags.scene.device, std::move(input.voxels), {});
      look(*renderer, flags, orbit_views(request, input.volume, flags.views), truth, line, device, bar.stage(fmt::format("voxels, {} times", factor)));
      line.made_ms += made;
      lines.push_back(std::move(line));
    }
  return lines;
}

double rms_levels(const Line& line, int views) { return 255.0 * std::sqrt(line.square / views); }

Table voxels_table(const std::vector<Line>& lines, int views) {
  Table table{.headings = {"way", "supersample", "lod", "voxels", "of samples", "nodes", "one child", "depth", "MB", "times grid", "RMS, levels", "made ms", "frame ms"}, .rows = {}, .left = 1};
  for (const Line& line : lines) {
    const auto& v = line.voxels;
    const auto count = [&](std::uint64_t VoxelStats::*member) { return v ? fmt::format("{}", (*v).*member) : "-"; };
    table.rows.push_back({line.way, line.factor ? fmt::format("{}", *line.factor) : "-", line.deviation ? fmt::format("{}", *line.deviation) : "-", count(&VoxelStats::voxels),
                          count(&VoxelStats::samples), count(&VoxelStats::nodes), count(&VoxelStats::one_child), v ? fmt::format("{}", v->depth) : "-",
                          three_digits(double(line.bytes) / 1e6), three_digits(double(line.bytes) / double(line.grid_bytes)), &line == lines.data() ? "-" : three_digits(rms_levels(line, views)),
                          three_digits(line.made_ms), three_digits(percentile(line.frame_ms, 0.5))});
  }
  return table;
}

Json voxels_json(const std::vector<Line>& lines, int views) {
  Json all = Json::array();
  for (const Line& line : lines) {
    Json row{{"way", line.way}, {"supersample", line.factor ? Json(*line.factor) : Json()}, {"lod", line.deviation ? Json(*line.deviation) : Json()}};
    if (const auto& v = line.voxels)
      row.update({{"voxels", v->voxels}, {"samples", v->samples}, {"nodes", v->nodes}, {"one_child", v->one_child}, {"depth", v->depth}});
    row.update({{"bytes", line.bytes}, {"grid_bytes", line.grid_bytes}, {"rms_levels", rms_levels(line, views)}, {"made_ms", line.made_ms}, {"frames_ms", line.frame_ms}});
    all.push_back(std::move(row));
  }
  return all;
}

void voxels(const VoxelsFlags& flags) {
  refuse_reference(flags.scene.device);
  check_something_is_seen(flags.scene);
  if (!flags.json.empty()) check_writable(flags.json);
  ProgressBar bar(flags.verbosity);
  std::string device;
  const std::vector<Line> lines = measure(flags, bar, device);
  bar.erase();

  const Table table = voxels_table(lines, flags.views);
  const std::string caption = fmt::format(
      "{}, transfer function {}, {} x {}, {} views, {} rounds; {}. MB on the device of coefficients, or of voxels, places and tree, and as a multiple of the samples in the file; "
      "RMS of colours in 1/255 against the first line; made: once, prefilter and bounds, or resampling, voxels and tree; frame: median.",
      flags.scene.volume, flags.scene.look.transfer_function, flags.scene.scene.width, flags.scene.scene.height, flags.views, flags.rounds, machine_text(this_machine(device)));
  if (!flags.json.empty()) write_text(Json{{"volume", flags.scene.volume}, {"transfer_function", flags.scene.look.transfer_function}, {"lines", voxels_json(lines, flags.views)}}.dump(2) + "\n",
                                      flags.json);
  fmt::print("{}", flags.markdown ? markdown_text(table) + "\n" + caption + "\n" : caption + "\n\n" + plain_text(table));
}

/// Numbers of at least `least`, ascending or not.
std::vector<double> numbers_from(const std::string& text, const std::string& flag, double least) {
  const std::vector<double> numbers = parse_numbers(text, flag);
  for (const double number : numbers)
    if (number < least) throw InputError(fmt::format("{}: found {}, expected numbers of at least {}", flag, number, least));
  return numbers;
}

}  // namespace

Command voxels_command(CLI::App& program) {
  auto flags = std::make_shared<VoxelsFlags>();
  flags->scene.scene.width = flags->scene.scene.height = 256;
  CLI::App* app = program.add_subcommand("voxels", "Voxels in a bounding interval hierarchy against ordinary volume rendering: memory, quality, time");
  app->footer(
      "Renders a volume through a transfer function in the usual way and as `render --render bih` does, each way by itself. Pictures are compared with those of the\n"
      "first line, a smooth spline in steps of a quarter cell.");
  app->add_option("VOLUME", flags->scene.volume, "NRRD file of a volume")->required();
  app->add_option("--tf", flags->scene.look.transfer_function, "Transfer function")->type_name("F.json")->required();
  add_parsed(*app, "--supersample", [flags](const std::string& text) { flags->factors = numbers_from(text, "--supersample", 1.0); }, "F[,F...]", "1,1.5,2", "Samples per axis in place of one, of voxels");
  add_parsed(*app, "--lod", [flags](const std::string& text) { flags->deviations = numbers_from(text, "--lod", 0.0); }, "D[,D...]", "",
             "Also voxels merged where they differ from their mean by no more than this, as --bih-lod does");
  add_size(*app, flags->scene.scene.width, flags->scene.scene.height);
  add_integer(*app, "--views", flags->views, 1, 1000, "Views of the orbit, their azimuths equally apart");
  add_integer(*app, "--repeat", flags->rounds, 1, 100000, "Timed frames of each way and view, after an untimed one");
  add_device(*app, flags->scene.device);
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { voxels(*flags); }};
}

}  // namespace quincunx

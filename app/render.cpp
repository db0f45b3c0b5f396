// quincunx render: isosurfaces of a volume, and the volume itself, to pictures.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "app/command.h"
#include "app/interrupt.h"
#include "app/render_flags.h"
#include "app/render_report.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "app/voxel_input.h"
#include "io/atomic_file.h"
#include "io/image_file.h"
#include "io/sample_file.h"
#include "io/volume_file.h"
#include "render/voxel_renderer.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

/// What a summary needs beside the flags.
struct Outcome {
  Json stats;
  std::optional<SampleRange> range;  ///< of the samples, where they are in memory
  bool walked_only = false;  ///< nothing could be hit
};

/// What a .png shows: the heat, or the surfaces.
Image picture(const RenderFlags& flags, const Frame& frame, const std::optional<HeatMap>& heat) {
  if (!heat) return flags.background_given ? to_opaque_image(frame) : to_image(frame);
  HeatPicture drawn = draw_heat(*heat);
  if (!drawn.labelled && flags.verbosity == Verbosity::normal)
    fmt::print(stderr, "note: no font found, the scale has no numbers\n");
  return std::move(drawn.image);
}

void write_outputs(const RenderFlags& flags, const Frame& frame, const std::optional<HeatMap>& heat, const Json& stats) {
  const auto is_png = [](const std::string& path) { return !is_exr(path); };
  const bool shown = std::any_of(flags.images.begin(), flags.images.end(), is_png);
  const Image channels = to_image(frame), shown_picture = shown ? picture(flags, frame, heat) : Image{};
  for (const std::string& path : flags.images) {
    stop_if_interrupted();
    write_image(is_exr(path) ? channels : shown_picture, path);
  }
  if (!flags.stats.empty()) write_text(stats.dump(2) + "\n", flags.stats);
}

/// One line: where the pictures are, what was hit, how long a frame took; and a second one where nothing was hit
/// although something could have been.
void print_summary(const RenderFlags& flags, const Outcome& outcome) {
  const std::string& shown = flags.volume.empty() ? flags.voxel.particles : flags.volume;
  const std::string made = flags.images.empty() ? shown : fmt::format("{}", fmt::join(flags.images, ", "));
  const Json& ms = outcome.stats["trace_ms"]["median"];
  const std::uint64_t hits = outcome.stats["hits"], rays = outcome.stats["rays"];
  fmt::print(stderr, "{}: {}{} on {}\n", made,
             outcome.walked_only ? fmt::format("{} rays walked to their end, nothing evaluated", rays)
                                 : fmt::format("{} of {} rays hit", hits, rays),
             ms.is_null() ? "" : fmt::format(", {:.1f} ms a frame", ms.get<double>()),
             outcome.stats["device"].get<std::string>());
  if (hits == 0 && !outcome.walked_only) {
    fmt::print(stderr, "note: nothing was hit{}\n",
               outcome.range ? fmt::format("; the samples go from {:g} to {:g}", outcome.range->min, outcome.range->max) : "");
  }
}

/// A volume that was opened: with its samples, or, where they stay in the file, with a source of them; or what is seen of it, as voxels.
struct Opened {
  Volume volume;  ///< without samples where there is a source, or where particles have none
  std::optional<VoxelInput> voxels;
  std::shared_ptr<const SampleSource> source;
  Renderer::Config config;  ///< with a pool where there is a source
  double read_ms = 0.0;
};

/// The size of the pool: the one that was asked for, or one because the volume does not fit otherwise, which a note says.
std::optional<std::uint64_t> pool_bytes(const RenderFlags& flags) {
  if (flags.config.pool_bytes) return flags.config.pool_bytes;
  const std::string why = why_not_whole(flags.device, read_volume_header(flags.volume), flags.config);
  if (why.empty()) return std::nullopt;
  const std::uint64_t bytes = default_pool_bytes(flags.device);
  if (flags.verbosity == Verbosity::normal)
    fmt::print(stderr, "note: {}: {}: rendered through a pool of {} (--pool)\n", flags.volume, why, readable_bytes(double(bytes)));
  return bytes;
}

Opened open_voxels(const RenderFlags& flags, ProgressBar& bar) {
  Opened opened;
  opened.config = flags.config;
  opened.voxels = read_voxels(flags, bar);
  opened.volume = std::move(opened.voxels->volume);
  opened.read_ms = opened.voxels->read_ms;
  return opened;
}

Opened open_volume(const RenderFlags& flags, ProgressBar& bar) {
  const Clock::time_point start = Clock::now();
  Opened opened;
  opened.config = flags.config;
  opened.config.pool_bytes = pool_bytes(flags);
  if (opened.config.pool_bytes) {
    opened.source = std::make_shared<SampleFile>(flags.volume, SampleFile::Config{flags.scratch}, bar.stage("unpacking"));
    opened.volume = opened.source->header();
  } else {
    opened.volume = read_finite_volume(flags.volume, bar.stage("reading"), flags.config.nan);
  }
  opened.read_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return opened;
}

std::unique_ptr<Renderer> open_renderer(const RenderFlags& flags, Opened& opened) {
  if (opened.voxels) return make_voxel_renderer(flags.device, std::move(opened.voxels->voxels), {.leaf_size = flags.voxel.leaf, .validation = opened.config.validation});
  return opened.source ? make_renderer(flags.device, opened.source, flags.volume, opened.config) : make_renderer(flags.device, opened.volume, opened.config);
}

Outcome trace(const RenderFlags& flags, Renderer& renderer, const Renderer::Request& request, const Opened& opened, ProgressBar& bar) {
  RenderStats stats;
  const Frame frame = renderer.render(request, stats, bar.stage("rendering"));
  Outcome outcome{opened.voxels ? voxels_json(flags.volume.empty() ? flags.voxel.particles : flags.volume, request, stats,
                                              {opened.voxels->read_ms, opened.voxels->resample_ms, opened.voxels->voxels_ms})
                                : stats_json(flags.volume, request, stats, opened.read_ms),
                  std::nullopt, request.scene.stub_sampling};
  if (!opened.source && !flags.volume.empty()) outcome.range = sample_range(opened.volume);
  std::optional<HeatMap> heat;
  if (flags.heat != HeatKind::none) {
    check_heat(flags.heat, request.scene, stats.skip.structure);
    heat = make_heat(flags.heat, frame, request.scene, stats);
    outcome.stats["heat"] = heat_json(flags.heat, *heat);
  }
  write_outputs(flags, frame, heat, outcome.stats);
  return outcome;
}

void render(const RenderFlags& flags) {
  check_render_flags(flags);
  ProgressBar bar(flags.verbosity);
  Opened opened = flags.voxel.voxels() ? open_voxels(flags, bar) : open_volume(flags, bar);
  const Renderer::Request request = make_request(flags, opened.volume);
  const auto renderer = open_renderer(flags, opened);
  stop_if_interrupted();
  Json printed = Json::object();
  Outcome outcome;
  if (flags.renders()) {
    outcome = trace(flags, *renderer, request, opened, bar);
    printed = outcome.stats;
    printed["images"] = flags.images;
  }
  const std::vector<Feature> features = flags.explain ? renderer->explain(request) : std::vector<Feature>{};
  if (flags.explain) printed["explain"] = explain_json(features);

  bar.erase();
  if (flags.json) {
    fmt::print("{}\n", printed.dump(2));
  } else if (flags.explain) {
    fmt::print("{}", explain_text(features));
  }
  if (flags.renders() && flags.verbosity == Verbosity::normal) print_summary(flags, outcome);
}

}  // namespace

Command render_command(CLI::App& program) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* app = program.add_subcommand("render", "Render isosurfaces of a volume, or the volume itself through a transfer function");
  app->footer("Example: quincunx render data/mri_head_bcc.nrrd --iso 130 -o head.png -o head.exr");
  add_render_flags(*app, *flags);
  return {app, [flags] { render(*flags); }};
}

}  // namespace quincunx

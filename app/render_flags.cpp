#include "app/render_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <set>

#include "app/flags.h"
#include "app/nan_flag.h"
#include "app/spline_flags.h"
#include "app/values.h"
#include "io/atomic_file.h"
#include "io/image_file.h"
#include "lattice/error.h"
#include "render/coefficient_texels.h"

namespace quincunx {
namespace {

using Texts = std::vector<std::string>;

/// Appends the numbers of every text to `values`.
std::function<void(const Texts&)> append_numbers(std::vector<double>& values, const char* flag) {
  return [&values, flag](const Texts& texts) {
    for (const std::string& text : texts) {
      for (const double value : parse_numbers(text, flag)) values.push_back(value);
    }
  };
}

/// One colour, or several "#rrggbb" separated by commas.
void append_colors(const std::string& text, std::vector<glm::dvec3>& colors) {
  if (!text.starts_with('#')) {
    colors.push_back(parse_color(text, "--color"));
    return;
  }
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    colors.push_back(parse_color(text.substr(start, comma - start), "--color"));
    start = comma + 1;
  }
}

void add_surface_flags(CLI::App& app, RenderFlags& flags) {
  const std::string group = "Surfaces";
  add_isovalues(app, flags)->group(group);
  const auto colors = [&flags](const Texts& texts) {
    for (const std::string& text : texts) append_colors(text, flags.colors);
  };
  app.add_option_function<Texts>("--color", colors,
                                 "Linear r,g,b of 0..1, or #rrggbb of sRGB; once for all surfaces or once each")
      ->type_name("COLOR")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option_function<Texts>("--opacity", append_numbers(flags.opacities, "--opacity"),
                                 "0..1, one for all surfaces or one each")
      ->type_name("V[,V...]")
      ->allow_extra_args(false)
      ->group(group);
  add_number(app, "--ambient", flags.scene.ambient, {0.0, 1.0}, "Part of the colour that no light is needed for")
      ->group(group);
  const auto background = [&flags](const std::string& text) {
    flags.scene.background = parse_color(text, "--background");
    flags.background_given = true;
  };
  add_parsed(app, "--background", background, "COLOR", "", "Colour behind everything; else black, transparent in .png")
      ->group(group);
}

void add_output_flags(CLI::App& app, RenderFlags& flags) {
  const std::string group = "Output";
  app.add_option("-o,--output", flags.images,
                 "Picture to write: .png for people, .exr with every channel; may stand several times")
      ->type_name("OUT")
      ->allow_extra_args(false)
      ->group(group);
  add_size(app, flags.scene.width, flags.scene.height)->group(group);
  app.add_flag("--cost", flags.scene.cost,
               "Also the cost channels in .exr: evaluations, steps, intervals of each pixel")
      ->group(group);
  add_choice(app, "--heat", flags.heat, heat_kinds(), "Make .png a heat picture of what each ray cost, with its scale")
      ->group(group);
  app.add_option("--stats", flags.stats, "JSON file of times, bytes and counts to write")
      ->type_name("S.json")
      ->group(group);
  app.add_flag("--explain", flags.explain, "Print what the kernel contains, what it leaves out, and why")->group(group);
  app.add_flag("--json", flags.json, "Print the summary (and --explain) as JSON")->group(group);
  add_quiet(app, flags.verbosity);
}

void add_method_flags(CLI::App& app, RenderFlags& flags) {
  const std::string group = "Method";
  add_intersect(app, flags)->group(group);
  add_step(app, flags)->group(group);
  add_spline(app, flags.config.spline)->group(group);
  add_prefilter(app, flags.config.prefilter)->group(group);
  add_precision(app, flags)->group(group);
  add_storage(app, flags.config.storage)->group(group);
  add_choice(app, "--normal", flags.scene.normal, {{"analytic", Normal::analytic}, {"central", Normal::central}, {"samples", Normal::samples}},
             "The spline's gradient, central differences of the spline, or of neighbouring samples, interpolated")
      ->group(group);
  add_number(app, "--delta", flags.scene.delta, {1e-3, 1e2}, "Of central, in cells")->each([&flags](const std::string&) { flags.delta_given = true; })->group(group);
  add_nan(app, flags.config.nan)->group(group);
  add_skip_flags(app, flags.skip, group);
  const auto pool = [&flags](const std::string& text) { flags.config.pool_bytes = parse_bytes(text, "--pool"); };
  add_parsed(app, "--pool", pool, "BYTES", "", "Read the volume brick by brick and keep at most so much of it on the device: 256M, 2G")
      ->group(group);
  const auto brick = [&flags](const std::string& text) { flags.config.brick = parse_brick(text, "--brick"); };
  add_parsed(app, "--brick", brick, "N", "32", "Edge of the pool's bricks in cells, a power of two from 4 to 256")->group(group);
  app.add_option("--scratch", flags.scratch, "Folder where a packed volume is unpacked for --pool; else TMPDIR or /tmp")->type_name("DIR")->group(group);
  app.add_flag("--stub-sampling", flags.scene.stub_sampling,
               "Walk the structure to the end of each ray and evaluate nothing: traversal alone")
      ->group(group);
  add_device(app, flags.device)->group(group);
  add_integer(app, "--repeat", flags.repeat, 1, 100000,
              "Frames to trace and time; where several, one more before them warms up")
      ->group(group);
  app.add_flag("--validate", flags.config.validation, "Turn Vulkan's validation layers on; any message is a failure")
      ->group(group);
}

void check_count(std::size_t found, std::size_t surfaces, const char* flag) {
  if (found <= 1 || found == surfaces) return;
  throw InputError(
      fmt::format("{}: found {} values for {} isovalues, expected one for all or one each", flag, found, surfaces));
}

void check_heat_flag(const RenderFlags& flags) {
  if (flags.heat == HeatKind::none) return;
  if (flags.heat == HeatKind::depth && flags.voxel.voxels())
    throw InputError("--heat: found depth with voxels, whose tree has no blocks; expected evaluations, steps or intervals");
  if (std::all_of(flags.images.begin(), flags.images.end(), is_exr))
    throw InputError("--heat: found no .png among the pictures of -o, expected -o OUT.png for the heat picture");
  if (flags.heat == HeatKind::depth && flags.device == "cpu")
    throw InputError("--heat: found depth with --device cpu, which walks no structure; expected a Vulkan device");
  check_heat(flags.heat, flags.scene, flags.skip.config.structure);
}

void check_outputs(const RenderFlags& flags) {
  std::set<std::string> seen;
  for (const std::string& path : flags.images) {
    check_image_path(path);
    if (!seen.insert(path).second) throw InputError(fmt::format("-o: found {} twice, expected different files", path));
  }
  if (flags.stats.empty()) return;
  check_writable(flags.stats);
  if (seen.contains(flags.stats)) {
    throw InputError(fmt::format("--stats: found {}, which -o names too, expected different files", flags.stats));
  }
}

/// What was asked for, or what fits.
Intersect intersect_of(const RenderFlags& flags) {
  if (flags.voxel.voxels() || flags.intersect || flags.config.spline.empty()) return flags.intersect.value_or(Intersect::exact);
  const Intersect fitting = default_intersect(flags.device, *make_spline(flags.config.spline));
  if (fitting == Intersect::march && !flags.isovalues.empty() && flags.verbosity == Verbosity::normal)
    fmt::print(stderr, "note: pieces of {} are no polynomials: surfaces are marched (--intersect march); --device cpu finds first roots\n", flags.config.spline);
  return fitting;
}

}  // namespace

bool is_exr(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".exr";
}

void add_render_flags(CLI::App& app, RenderFlags& flags) {
  flags.app = &app;
  app.add_option("VOLUME", flags.volume, "NRRD file of a volume; none with --particles");
  add_output_flags(app, flags);
  add_surface_flags(app, flags);
  add_volume_flags(app, flags.look);
  add_camera_flags(app, flags.camera);
  add_method_flags(app, flags);
  add_voxel_flags(app, flags.voxel);
}

CLI::Option* add_isovalues(CLI::App& app, RenderFlags& flags) {
  return app.add_option_function<Texts>("--iso", append_numbers(flags.isovalues, "--iso"), "Isovalues; `quincunx info` helps to choose")
      ->type_name("V[,V...]")
      ->allow_extra_args(false);
}

CLI::Option* add_intersect(CLI::App& app, RenderFlags& flags) {
  const std::vector<std::string> choices{"exact", "march"};
  const auto parse = [&flags, choices](const std::string& text) {
    check_choice(text, "--intersect", choices);
    flags.intersect = text == "exact" ? Intersect::exact : Intersect::march;
  };
  return add_parsed(app, "--intersect", parse, choices_text(choices), "exact",
                    "First root of the polynomial pieces, or fixed steps: the default where pieces are no polynomials (cwlb) and the device is not cpu");
}

CLI::Option* add_step(CLI::App& app, RenderFlags& flags) {
  const auto step = [&flags](const std::string& text) {
    flags.step = parse_number(text, "--step");
    if (!(flags.step >= 1e-3 && flags.step <= 1e3)) throw InputError(fmt::format("--step: found {}, expected a number from 0.001 to 1000", text));
  };
  return add_parsed(app, "--step", step, "NUMBER", "0.25 of march, 1 of a volume", "Of march and of volumes, in cells");
}

CLI::Option* add_precision(CLI::App& app, RenderFlags& flags) {
  return add_choice(app, "--precision", flags.config.precision, {{"float", Precision::float32}, {"double", Precision::float64}},
                    "Of what a device computes: 32-bit floats, or 64-bit ones where it has them");
}

void check_something_is_seen(const RenderFlags& flags) {
  check_volume_flags(flags.look);
  if (!flags.isovalues.empty() || !flags.look.transfer_function.empty()) return;
  throw InputError(
      "--iso: found neither an isovalue nor --tf, expected one of them; 'quincunx info VOLUME' shows the range and the quantiles");
}

void check_render_flags(const RenderFlags& flags) {
  check_voxel_flags(*flags.app, flags.voxel, flags.volume, flags.look.transfer_function);
  check_something_is_seen(flags);
  if (!flags.renders() && !flags.explain) {
    throw InputError("-o: found nothing to make, expected -o OUT.png or OUT.exr, --stats, --json or --explain");
  }
  check_count(flags.colors.size(), flags.isovalues.size(), "--color");
  check_count(flags.opacities.size(), flags.isovalues.size(), "--opacity");
  check_storage(flags.config.storage, flags.config.precision);
  if (flags.config.precision == Precision::float64 && flags.config.pool_bytes)
    throw InputError("--precision: found double with --pool, expected float: bricks hold 32-bit floats");
  if (flags.scene.normal == Normal::samples && flags.delta_given)
    throw InputError("--delta: found it with --normal samples, whose differences are those of neighbouring samples; expected --normal central");
  check_camera_flags(flags.camera);
  check_skip_flags(flags.skip);
  check_outputs(flags);
  check_heat_flag(flags);
}

std::vector<Isosurface> make_isosurfaces(const RenderFlags& flags) {
  // sRGB, from the lowest isovalue (as a rule the outermost surface) inwards; the highest has the last one.
  constexpr std::array<std::uint32_t, 5> outer{0xE6B08F, 0xC8553D, 0x4F9D69, 0x3F7CAC, 0xE0B34C};
  constexpr std::uint32_t innermost = 0xF4ECDC;
  constexpr double outer_opacity = 0.35;
  const std::size_t count = flags.isovalues.size();
  std::vector<double> ascending = flags.isovalues;
  std::sort(ascending.begin(), ascending.end());

  std::vector<Isosurface> surfaces(count);
  for (std::size_t n = 0; n < count; ++n) {
    Isosurface& surface = surfaces[n];
    surface.isovalue = flags.isovalues[n];
    if (count > 1) {
      const auto place = std::lower_bound(ascending.begin(), ascending.end(), surface.isovalue);
      const std::size_t rank = std::size_t(place - ascending.begin());
      const bool last = rank + 1 == count;
      surface.color = srgb_color(last ? innermost : outer[rank % outer.size()]);
      surface.opacity = last ? 1.0 : outer_opacity;
    }
    if (!flags.colors.empty()) surface.color = flags.colors[flags.colors.size() == 1 ? 0 : n];
    if (!flags.opacities.empty()) surface.opacity = flags.opacities[flags.opacities.size() == 1 ? 0 : n];
  }
  return surfaces;
}

Scene make_scene(const RenderFlags& flags) {
  Scene scene = flags.scene;
  scene.intersect = intersect_of(flags);
  scene.isosurfaces = make_isosurfaces(flags);
  if (flags.step > 0.0) scene.step = flags.step;
  scene.volume = make_direct_volume(flags.look, flags.step > 0.0 ? flags.step : 1.0);
  return scene;
}

Renderer::Request make_request(const RenderFlags& flags, const Volume& volume) {
  Renderer::Request request{.scene = make_scene(flags),
                            .skip = flags.skip.config,
                            .repeat = flags.repeat,
                            .count_costs = !flags.stats.empty() || flags.json};
  request.scene.cost = flags.scene.cost || flags.heat != HeatKind::none;
  request.scene.stub_sampling = flags.scene.stub_sampling || flags.heat == HeatKind::depth;
  request.scene.camera = make_camera(flags.camera, volume, request.scene.width, request.scene.height);
  check_scene(request.scene);
  return request;
}

}  // namespace quincunx

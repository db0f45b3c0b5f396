#include "app/voxel_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/flags.h"
#include "app/values.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr const char* kGroup = "Voxels (--render bih)";

/// What a picture of voxels can be asked for beside the camera's flags and those of kGroup.
const std::set<std::string>& flags_of_voxels() {
  static const std::set<std::string> names{"VOLUME", "--output", "--size", "--cost", "--heat", "--stats", "--explain", "--json", "--quiet", "--ambient", "--background",
                                           "--tf", "--shade", "--modulate", "--termination", "--nan", "--device", "--repeat", "--validate"};
  return names;
}

/// Those that choose how a volume is resampled.
bool resamples(const std::string& name) { return name == "--spline" || name == "--prefilter"; }

std::string name_of(const CLI::Option& option) {
  if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
  return option.get_name();
}

bool given(const CLI::App& app, const std::string& name) {
  const auto options = app.get_options();
  return std::any_of(options.begin(), options.end(), [&](const CLI::Option* o) { return o->count() > 0 && name_of(*o) == name; });
}

void check_particles(const CLI::App& app, const VoxelFlags& flags, const std::string& volume) {
  if (flags.particles.empty()) {
    if (flags.radius) throw InputError("--radius: found without --particles, expected --particles POINTS.csv");
    return;
  }
  if (!volume.empty()) throw InputError(fmt::format("--particles: found with the volume {}, expected one of both", volume));
  for (const char* name : {"--bih-min", "--bih-lod", "--supersample", "--modulate", "--nan"})
    if (given(app, name)) throw InputError(fmt::format("{}: found with --particles, expected a volume: particles have no grid and no gradients", name));
}

}  // namespace

void add_voxel_flags(CLI::App& app, VoxelFlags& flags) {
  const std::vector<std::string> ways{"spline", "bih"};
  const auto way = [&flags, ways](const std::string& text) {
    check_choice(text, "--render", ways);
    flags.way = text == "bih" ? RenderWay::bih : RenderWay::spline;
  };
  add_parsed(app, "--render", way, choices_text(ways), "spline",
             "See the volume as a spline of its samples, or as voxels of one density each in a bounding interval hierarchy (with --tf)")
      ->group(kGroup);
  const auto minimum = [&flags](const std::string& text) { flags.minimum = parse_number(text, "--bih-min"); };
  add_parsed(app, "--bih-min", minimum, "V", "", "Samples of at least this value are voxels; else those above the least value to which the transfer function gives opacity")
      ->group(kGroup);
  const auto deviation = [&flags](const std::string& text) {
    flags.deviation = parse_number(text, "--bih-lod");
    if (*flags.deviation < 0.0) throw InputError(fmt::format("--bih-lod: found {}, expected a number of at least 0", text));
  };
  add_parsed(app, "--bih-lod", deviation, "DEVIATION", "", "Merge sibling voxels to larger ones as long as no sample differs from their mean by more")
      ->group(kGroup);
  add_integer(app, "--bih-leaf", flags.leaf, 1, 64, "Voxels of a leaf of the tree, at most: fewer nodes, more voxels to look at; changes no picture")->group(kGroup);
  add_number(app, "--supersample", flags.supersample, {1.0, 8.0}, "Samples per axis in place of one, by the spline")->group(kGroup);
  app.add_option("--particles", flags.particles, "In place of a volume: spheres, a CSV file of x,y,z[,radius][,density] (world)")
      ->type_name("POINTS.csv")
      ->group(kGroup);
  const auto radius = [&flags](const std::string& text) {
    flags.radius = parse_number(text, "--radius");
    if (!(*flags.radius > 0.0)) throw InputError(fmt::format("--radius: found {}, expected a number above 0", text));
  };
  add_parsed(app, "--radius", radius, "R", "", "Of particles whose file has no column radius, in world units")->group(kGroup);
}

void check_voxel_flags(const CLI::App& app, const VoxelFlags& flags, const std::string& volume, const std::string& transfer_function) {
  if (volume.empty() && flags.particles.empty()) throw InputError("VOLUME: found none, expected an NRRD file of a volume, or --particles");
  if (!flags.voxels()) {
    if (!flags.particles.empty()) throw InputError("--render: found spline with --particles, expected bih");
    for (const CLI::Option* option : app.get_options())
      if (option->count() > 0 && option->get_group() == kGroup && name_of(*option) != "--render")
        throw InputError(fmt::format("{}: found without --render bih, expected --render bih", name_of(*option)));
    return;
  }
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = name_of(*option);
    if (option->count() == 0 || option->get_group() == kGroup || option->get_group().starts_with("Camera") || flags_of_voxels().contains(name)) continue;
    if (resamples(name) && flags.supersample != 1.0) continue;
    throw InputError(fmt::format("{}: found with {}, which has no such thing{}; expected --render spline", name, flags.particles.empty() ? "--render bih" : "--particles",
                                 resamples(name) && flags.particles.empty() ? " without --supersample" : ""));
  }
  if (transfer_function.empty()) throw InputError(fmt::format("--tf: found {} without it, expected --tf TF.json", flags.particles.empty() ? "--render bih" : "--particles"));
  check_particles(app, flags, volume);
}

}  // namespace quincunx

// quincunx convert: to the other lattice by choosing samples, or to any lattice by resampling a spline.
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>

#include "app/command.h"
#include "app/flags.h"
#include "app/spline_flags.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "io/atomic_file.h"
#include "io/volume_file.h"
#include "lattice/error.h"
#include "lattice/low_pass.h"
#include "lattice/memory.h"
#include "lattice/resample.h"
#include "spline/spline_samples.h"

namespace quincunx {
namespace {

enum class Method { subset, spline };
enum class Filtering { automatic, on, off };

struct ConvertFlags {
  std::string in, out, lattice;
  std::optional<Method> method;  ///< none: spline where a density is asked for, else subset
  std::string spline;            ///< empty: the lattice's
  Spline::Prefilter prefilter = Spline::Prefilter::automatic;
  std::optional<Extents> dims;
  std::optional<double> spacing;
  std::optional<std::int64_t> samples;
  Filtering low_pass = Filtering::automatic;
  SampleType type = SampleType::float32;
  std::vector<std::string> of_spline;  ///< flags given that only resampling has
  Encoding encoding = Encoding::gzip;
  Verbosity verbosity = Verbosity::normal;

  int densities() const { return dims.has_value() + spacing.has_value() + samples.has_value(); }
  std::string_view density() const { return dims ? "--dims" : spacing ? "--spacing" : "--samples"; }
  Method way() const { return method.value_or(densities() > 0 ? Method::spline : Method::subset); }
};

/// Adds `line` to the note `history`, after what stands there already.
void add_history(Volume& volume, const std::string& line) {
  for (auto& [key, value] : volume.notes) {
    if (key != "history") continue;
    value += "; " + line;
    return;
  }
  volume.notes.emplace_back("history", line);
}

Volume chosen(const ConvertFlags& flags, LatticeKind target, ProgressBar& bar) {
  const Volume volume = read_volume(flags.in, bar.stage("reading"));
  if (volume.lattice == target) {
    throw InputError(fmt::format("{}: found a {} volume already, expected one of the other lattice for --lattice {}; --method spline resamples",
                                 flags.in, lattice_name(target), lattice_name(target)));
  }
  Volume converted = target == LatticeKind::bcc ? bcc_subset(volume, flags.in) : cartesian_subset(volume);
  add_history(converted, target == LatticeKind::bcc ? "the even and the odd points of a Cartesian volume"
                                                    : "the even coset of a BCC volume");
  return converted;
}

TargetGrid grid_of(const ConvertFlags& flags, LatticeKind target, const Volume& volume) {
  if (flags.dims) return grid_of_extents(volume, target, *flags.dims);
  if (flags.spacing) return grid_of_spacing(volume, target, *flags.spacing);
  return grid_of_count(volume, target, std::uint64_t(*flags.samples));
}

/// The cut-off of the low-pass along each axis, cycles per lattice coordinate of the volume: what the coarser of both lattices holds. Infinite along
/// axes of a Cartesian volume that need none; none where no axis needs one.
std::optional<glm::dvec3> cutoff_of(Filtering filtering, const Volume& volume, const TargetGrid& grid) {
  constexpr double kCoarser = 0.99;  // of the limit: lattices of equal density are as fine as each other
  const double own = band_limit(volume.lattice);
  const glm::dvec3 target = band_limit(grid.lattice) / relative_steps(grid, volume.world), cutoff = glm::min(target, glm::dvec3(own));
  const auto needed = [&](int a) { return filtering == Filtering::on || target[a] < kCoarser * own; };
  if (filtering == Filtering::off || !(needed(0) || needed(1) || needed(2))) return std::nullopt;
  if (volume.lattice == LatticeKind::bcc) return cutoff;
  constexpr double inf = std::numeric_limits<double>::infinity();
  return glm::dvec3(needed(0) ? cutoff.x : inf, needed(1) ? cutoff.y : inf, needed(2) ? cutoff.z : inf);
}

std::string history_line(const Spline& spline, const ConvertFlags& flags, const std::optional<glm::dvec3>& cutoff) {
  const std::string filter = cutoff ? fmt::format(", after a low-pass of {:.4g}, {:.4g}, {:.4g} cycles a cell", cutoff->x, cutoff->y, cutoff->z) : "";
  return fmt::format("resampled by {} (prefilter {}) from a {} volume{}", spline.name(), prefilter_name(spline.filter(flags.prefilter).kind),
                     lattice_name(spline.lattice()), filter);
}

Volume resampled(const ConvertFlags& flags, LatticeKind target, ProgressBar& bar) {
  Volume volume = read_finite_volume(flags.in, bar.stage("reading"));
  const std::string_view usual = volume.lattice == LatticeKind::bcc ? "bcc7" : "tricubic";
  const auto spline = make_spline(flags.spline.empty() ? usual : std::string_view(flags.spline), volume.lattice);
  spline->filter(flags.prefilter);
  const TargetGrid grid = grid_of(flags, target, volume);
  check_fits_memory(checked_sample_count(grid.lattice, grid.extents, flags.type, flags.density()) * sample_type_bytes(flags.type), flags.density());
  const std::optional<glm::dvec3> cutoff = cutoff_of(flags.low_pass, volume, grid);
  if (cutoff) volume = low_pass(volume, *cutoff, bar.stage("low-pass"));
  const Coefficients<double> coefficients = spline->coefficients(volume, flags.prefilter, bar.stage("prefilter"));
  volume.samples = {};
  Volume result = spline_samples(*spline, coefficients, grid, flags.type, bar.stage("resampling"));
  result.notes = volume.notes;
  add_history(result, history_line(*spline, flags, cutoff));
  return result;
}

void check_convert_flags(const ConvertFlags& flags) {
  if (flags.way() == Method::subset) {
    if (!flags.of_spline.empty()) throw InputError(fmt::format("{}: found it with --method subset, which keeps samples as they are; expected --method spline", flags.of_spline.front()));
    return;
  }
  if (flags.densities() == 1) return;
  throw InputError(fmt::format("--method: found spline with {} of --dims, --spacing and --samples, expected one of them", flags.densities() == 0 ? "none" : "several"));
}

void convert(const ConvertFlags& flags) {
  const LatticeKind target = parse_lattice(flags.lattice, "--lattice");
  check_convert_flags(flags);
  check_writable(flags.out);
  ProgressBar bar(flags.verbosity);
  const Volume volume = flags.way() == Method::subset ? chosen(flags, target, bar) : resampled(flags, target, bar);
  write_volume(volume, flags.out, flags.encoding, bar.stage("writing"));
}

/// The flags that only resampling has.
void add_spline_flags(CLI::App& app, ConvertFlags& flags) {
  const std::string group = "Resampling (--method spline)";
  const auto note = [&flags](CLI::Option* option) {
    const std::string name = option->get_name();
    option->each([&flags, name](const std::string&) { flags.of_spline.push_back(name); });
    return option;
  };
  const auto parse_dims = [&flags](const std::vector<std::string>& texts) {
    constexpr std::int64_t most = std::int64_t(1) << 31;
    flags.dims = Extents(0);
    for (int a = 0; a < 3; ++a) (*flags.dims)[a] = parse_integer(texts[std::size_t(a)], "--dims", 1, most);
  };
  note(app.add_option_function<std::vector<std::string>>("--dims", parse_dims, "Samples per axis of OUT; on the BCC lattice, of each of the two cosets"))
      ->type_name("NX NY NZ")
      ->type_size(3)
      ->expected(1)
      ->group(group);
  const auto parse_spacing = [&flags](const std::string& text) {
    flags.spacing = parse_number(text, "--spacing");
    if (!(*flags.spacing > 0.0)) throw InputError(fmt::format("--spacing: found {}, expected a number above 0", text));
  };
  note(add_parsed(app, "--spacing", parse_spacing, "S", "", "Or: the step of OUT's grid, on the BCC lattice of one coset's, along each axis in world units"))->group(group);
  const auto parse_samples = [&flags](const std::string& text) { flags.samples = parse_integer(text, "--samples", 1, std::int64_t(1) << 40); };
  note(add_parsed(app, "--samples", parse_samples, "N", "", "Or: about so many samples in all, in cells of the shape of IN's"))->group(group);
  note(add_spline(app, flags.spline))->description("Of IN's lattice; else bcc7 of BCC volumes, tricubic of Cartesian ones")->group(group);
  note(add_prefilter(app, flags.prefilter))->group(group);
  note(add_choice(app, "--low-pass", flags.low_pass, {{"auto", Filtering::automatic}, {"on", Filtering::on}, {"off", Filtering::off}},
                  "Take out of IN what OUT is too coarse for: auto, where it is coarser along an axis"))
      ->group(group);
  note(add_choice(app, "--type", flags.type, {{"uint8", SampleType::uint8}, {"int16", SampleType::int16}, {"uint16", SampleType::uint16}, {"float", SampleType::float32}},
                  "Of OUT's samples; integers are the nearest there are"))
      ->group(group);
}

}  // namespace

Command convert_command(CLI::App& program) {
  auto flags = std::make_shared<ConvertFlags>();
  CLI::App* app = program.add_subcommand("convert", "Turn a volume into one on the other lattice, or on a grid of another density");
  app->footer(
      "--method subset, the default without a density: to bcc the points whose coordinates are all even or all odd, a quarter of the\n"
      "samples; to cartesian the even coset, half of them. Values, types and places stay as they are.\n"
      "--method spline, the default with --dims, --spacing or --samples: the spline of IN at the points of OUT, whose origin and directions are IN's.");
  app->add_option("IN", flags->in, "NRRD file to read")->required();
  app->add_option("OUT", flags->out, "NRRD file to write")->required();
  add_choice_name(*app, "--lattice", flags->lattice, {"bcc", "cartesian"}, "Lattice of OUT")->required();
  const std::vector<std::string> methods{"subset", "spline"};
  const auto parse_method = [flags, methods](const std::string& text) {
    check_choice(text, "--method", methods);
    flags->method = text == "subset" ? Method::subset : Method::spline;
  };
  add_parsed(*app, "--method", parse_method, choices_text(methods), "", "Samples of IN as they are, or of a spline of it");
  add_spline_flags(*app, *flags);
  add_choice(*app, "--encoding", flags->encoding, {{"gzip", Encoding::gzip}, {"raw", Encoding::raw}},
             "How OUT is packed");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { convert(*flags); }};
}

}  // namespace quincunx

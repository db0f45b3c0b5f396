#include "bench/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "accel/structure.h"
#include "app/flags.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "bench/compare_page.h"
#include "bench/compare_plot.h"
#include "bench/compare_presets.h"
#include "bench/compare_report.h"
#include "bench/gnuplot.h"
#include "bench/open_device.h"
#include "bench/output_folder.h"
#include "bench/skip_lists.h"
#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

struct CompareFlags {
  std::string subject, folder, device, preset;
  CompareWishes wishes;  ///< what was asked for by flags
  bool json = false, markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

bool is_field(const std::string& name) { return std::find(field_names().begin(), field_names().end(), name) != field_names().end(); }

/// Items of a list, each made of its word by `parse`, no two alike.
template <class T, class Parse>
std::vector<T> parse_items(const std::string& text, std::string_view flag, const Parse& parse) {
  std::vector<T> items;
  for (const std::string_view word : split_list(text)) {
    T item = parse(std::string(word));
    if (std::find(items.begin(), items.end(), item) != items.end()) throw InputError(fmt::format("{}: found {} twice, expected different ones", flag, word));
    items.push_back(std::move(item));
  }
  return items;
}

std::string parse_spline(const std::string& word) { return std::string(make_spline(word)->name()); }

Spline::Prefilter parse_prefilter(const std::string& word) {
  for (const auto kind : {Spline::Prefilter::automatic, Spline::Prefilter::none, Spline::Prefilter::fir, Spline::Prefilter::iir})
    if (prefilter_name(kind) == word) return kind;
  throw InputError(fmt::format("--prefilters: found {}, expected auto, none, fir or iir", word));
}

Intersect parse_intersect(const std::string& word) {
  check_choice(word, "--intersect", {"exact", "march"});
  return word == "exact" ? Intersect::exact : Intersect::march;
}

Storage parse_storage(const std::string& word) {
  std::vector<std::string> names;
  for (const Storage storage : kStorages) {
    names.emplace_back(storage_name(storage));
    if (names.back() == word) return storage;
  }
  throw InputError(fmt::format("--storage: found {}, expected {}", word, fmt::join(names, ", ")));
}

Density parse_density(const std::string& word) {
  check_choice(word, "--densities", {"equal", "sparse"});
  return word == "equal" ? Density::equal : Density::sparse;
}

double parse_between(const std::string& word, std::string_view flag, double low, double high) {
  const double x = parse_number(word, flag);
  if (!(x >= low && x <= high)) throw InputError(fmt::format("{}: found {}, expected numbers from {} to {}", flag, word, low, high));
  return x;
}

/// "analytic", "samples", or the half-step of central differences in cells.
NormalChoice parse_normal(const std::string& word) {
  if (word == "analytic") return {};
  if (word == "samples") return {Normal::samples, 0.0};
  return {Normal::central, parse_between(word, "--normals", 1e-3, 1e2)};
}

/// A label of skip_labels(), or auto.
SkipConfig parse_skip(const std::string& word) {
  if (word == "auto") return {};
  return labelled_skip(word);
}

CompareSubject make_subject(const CompareFlags& flags, const ComparePreset& preset, ProgressBar& bar) {
  const std::string name = flags.subject.empty() ? preset.field : flags.subject;
  if (is_field(name)) {
    CompareSubject subject = field_subject(make_field(name), preset.samples, preset.densities, bar.stage("sampling"));
    if (flags.wishes.isovalue) subject.isovalue = *flags.wishes.isovalue;
    return subject;
  }
  if (!flags.wishes.isovalue) throw InputError("--iso: found no isovalue for a volume, expected one; 'quincunx info VOLUME' shows the range and the quantiles");
  Volume volume = read_finite_volume(name, bar.stage("reading"));
  if (preset.reduce == 1.0 || (volume.lattice == LatticeKind::bcc && !flags.wishes.reduce)) return volume_subject(name, std::move(volume), *flags.wishes.isovalue);
  return reduced_subject(name, volume, *flags.wishes.isovalue, preset.reduce, preset.densities, bar.stage("resampling"));
}

/// The command line that makes the same again, without what only tells where it goes.
std::string command_text(const CLI::App& app) {
  std::string text = "quincunx compare";
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "--output" || name == "--device" || name == "--quiet" || name == "--json" || name == "--markdown" || name == "--help") continue;
    text += option->get_positional() ? "" : " " + name;
    for (const std::string& word : option->results()) text += " " + shell_quoted(word);
  }
  return text;
}

const CompareMetric& chosen_metric(const CompareFlags& flags, const CompareSubject& subject) {
  const CompareMetric& metric = compare_metric(flags.wishes.error);
  if (!metric.against_truth || subject.truth) return metric;
  std::vector<std::string_view> others;
  for (const CompareMetric& other : compare_metrics())
    if (!other.against_truth) others.push_back(other.name);
  throw InputError(fmt::format("--error: found {}, which is told of the truth, and {} has none; expected one of {}", metric.name, subject.name, fmt::join(others, ", ")));
}

void compare(const CompareFlags& flags, const std::string& command) {
  refuse_reference(flags.device);
  const ComparePreset preset = with_wishes(compare_preset(flags.preset), flags.wishes);
  if (flags.subject.empty() && preset.field.empty()) throw InputError("VOLUME: found neither a volume, a field nor --preset, expected one of them");
  OutputFolder folder(flags.folder);
  ProgressBar bar(flags.verbosity);
  const CompareSubject subject = make_subject(flags, preset, bar);
  CompareReport report{.command = command, .machine = {}, .subject = &subject, .plan = preset.plan, .measured = {}, .metric = &chosen_metric(flags, subject)};
  report.plan.settings = compare_settings(subject, preset.choices);
  folder.prepare({"compare.csv", "compare.json", "compare.md", "compare.html", "compare.svg"});
  report.measured = measure_compare(subject, report.plan, std::make_shared<KernelCache>(open_device(flags.device)), bar.stage("comparing"));
  report.machine = this_machine(report.measured.device);
  bar.erase();

  write_text(compare_csv(report), folder.file("compare.csv"));
  write_text(compare_json(report).dump(2) + "\n", folder.file("compare.json"));
  write_text(compare_markdown(report), folder.file("compare.md"));
  write_text(compare_html(report), folder.file("compare.html"));
  draw_or_note(compare_plot_script(report), folder.file("compare.svg"));
  if (flags.json) {
    fmt::print("{}\n", compare_json(report).dump(2));
  } else if (flags.markdown) {
    fmt::print("{}", compare_markdown(report));
  } else if (flags.verbosity == Verbosity::normal) {
    fmt::print("{}", compare_text(report));
  }
}

template <class T, class Parse>
void add_list(CLI::App& app, const std::string& flag, std::optional<std::vector<T>>& value, const std::string& shape, const std::string& shown, const std::string& help, const Parse& parse) {
  add_parsed(app, flag, [&value, flag, parse](const std::string& text) { value = parse_items<T>(text, flag, parse); }, shape, shown, help);
}

void add_count(CLI::App& app, const std::string& flag, std::optional<int>& value, int low, int high, const std::string& shown, const std::string& help) {
  add_parsed(app, flag, [&value, flag, low, high](const std::string& text) { value = int(parse_integer(text, flag, low, high)); }, "N", shown, help);
}

void add_choices(CLI::App& app, CompareWishes& wishes) {
  const auto step = [](const std::string& word) { return parse_between(word, "--steps", 1e-3, 1e3); };
  add_list<std::string>(app, "--splines", wishes.splines, "S[,S...]", "all", "Splines, each on the volumes of its lattice", parse_spline);
  add_list<Spline::Prefilter>(app, "--prefilters", wishes.prefilters, "P[,P...]", "auto", "Prefilters, of those that a spline has: auto, none, fir, iir", parse_prefilter);
  add_list<Storage>(app, "--storage", wishes.storages, "F[,F...]", "float32", "Coefficients on the device: float32, float16, unorm16, unorm8", parse_storage);
  add_list<Intersect>(app, "--intersect", wishes.intersects, "I[,I...]", "exact,march", "Ways to the first hit", parse_intersect);
  add_list<double>(app, "--steps", wishes.steps, "X[,X...]", "0.5,0.25,0.125", "Of march, in cells", step);
  add_list<NormalChoice>(app, "--normals", wishes.normals, "N[,N...]", "analytic", "Gradients: analytic, of neighbouring samples (samples), or the half-step in cells of central differences", parse_normal);
  add_list<SkipConfig>(app, "--structures", wishes.skips, "L[,L...]", "auto", fmt::format("Skipping structures: auto, {}", fmt::join(skip_labels(), ", ")), parse_skip);
  add_list<Density>(app, "--densities", wishes.densities, "D[,D...]", "equal", "BCC samples: as many as Cartesian ones, or sparse, 29.3 % fewer", parse_density);
  add_parsed(app, "--reduce", [&wishes](const std::string& text) { wishes.reduce = parse_between(text, "--reduce", 1.0, 16.0); }, "X", "2",
             "A Cartesian volume is the truth, and is resampled by steps X times as long; 1: as it is");
  add_count(app, "--samples", wishes.samples, 8, 1024, "41", "Cartesian samples of a field along each axis");
}

}  // namespace

Command compare_command(CLI::App& program) {
  auto flags = std::make_shared<CompareFlags>();
  CLI::App* app = program.add_subcommand("compare", "Error against time: splines, ways to the hit, gradients, skipping");
  app->footer(fmt::format(
      "Renders every combination that the lists allow and times them in turns. Errors are told apart: against the double-precision reference of the same spline (what the intersection gets wrong), and,\n"
      "for an analytic field ({}), or a Cartesian volume that is resampled, against that itself (what the reconstruction gets wrong too). Writes compare.csv, .json, .md, a page compare.html that needs no network, and compare.svg.",
      fmt::join(field_names(), ", ")));
  CompareWishes& wishes = flags->wishes;
  app->add_option("VOLUME", flags->subject, "NRRD file, or the name of a field")->type_name("VOLUME|FIELD");
  app->add_option("-o,--output", flags->folder, "Folder to write to, made if it is not there")->type_name("DIR")->required();
  add_choice_name(*app, "--preset", flags->preset, compare_preset_names(), "What to compare, where other flags do not say");
  add_parsed(*app, "--iso", [&wishes](const std::string& text) { wishes.isovalue = parse_number(text, "--iso"); }, "NUMBER", "that of the field", "Isovalue");
  add_choices(*app, wishes);
  std::vector<std::string> metrics;
  for (const CompareMetric& metric : compare_metrics()) metrics.emplace_back(metric.name);
  add_choice_name(*app, "--error", wishes.error, metrics, "What compare.svg and the front of the tables are about");
  wishes.size = {256, 256};
  wishes.error = "image";
  add_size(*app, wishes.size->x, wishes.size->y);
  const auto add_angle = [&](const char* flag, std::optional<double>& value, const std::string& shown, const char* help) {
    add_parsed(*app, flag, [&value, flag](const std::string& text) { value = parse_number(text, flag); }, "NUMBER", shown, help);
  };
  add_angle("--azimuth", wishes.azimuth, "30", "Of the first view, degrees about z, as of `quincunx render`");
  add_angle("--elevation", wishes.elevation, "10", "Likewise, degrees above the xy plane");
  add_angle("--zoom", wishes.zoom, "1", "Likewise, by a narrower field of view");
  add_count(*app, "--orbit", wishes.views, 1, 360, "1", "Views around the volume");
  add_count(*app, "--rounds", wishes.rounds, 1, 1000, "5", "Timed frames of each combination and view");
  add_count(*app, "--points", wishes.points, 1, 10000000, "20000", "Random points where values and gradients are compared");
  add_count(*app, "--seed", wishes.seed, 0, 1000000000, "1", "Of these points");
  add_device(*app, flags->device);
  app->add_flag("--json", flags->json, "Print compare.json");
  app->add_flag("--markdown", flags->markdown, "Print the tables as Markdown");
  add_quiet(*app, flags->verbosity);
  return {app, [flags, app] { compare(*flags, command_text(*app)); }};
}

}  // namespace quincunx

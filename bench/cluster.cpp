#include "bench/cluster.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/flags.h"
#include "app/values.h"
#include "app/volume_input.h"
#include "bench/cluster_masks.h"
#include "bench/cluster_report.h"
#include "bench/skip_lists.h"
#include "io/atomic_file.h"
#include "lattice/error.h"
#include "spline/spline.h"

namespace quincunx {
namespace {

struct ClusterFlags {
  std::vector<std::string> volumes;
  std::vector<double> isovalues;
  std::vector<int> blocks{2, 4, 8}, sizes{64, 256};
  int max_cluster = 16, rounds = 3;
  std::string json;
  bool generated = false, markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

void check(const ClusterFlags& flags) {
  const std::size_t found = flags.isovalues.size(), volumes = flags.volumes.size();
  if (volumes == 0 && found > 0) throw InputError("--iso: found no volume, expected one that it is of");
  if (volumes > 0 && found != 1 && found != volumes)
    throw InputError(fmt::format("--iso: found {} isovalue{} for {} volume{}, expected one for all or one for each", found,
                                 found == 1 ? "" : "s", volumes, volumes == 1 ? "" : "s"));
  if (!flags.json.empty()) check_writable(flags.json);
}

void measure_volume(const ClusterFlags& flags, const std::string& path, double isovalue, ClusterReport& report, ProgressBar& bar) {
  const std::string name = std::filesystem::path(path).stem().string();
  const Volume volume = read_bcc_volume(path, bar.stage("reading"));
  const auto spline = make_spline("bcc7");
  const auto coefficients = spline->coefficients_float(volume, Spline::Prefilter::automatic, {}, bar.stage("prefilter"));
  const CellBounds cells = cell_bounds(*spline, coefficients, bar.stage("bounds"));
  const Progress progress = bar.stage(name);
  for (std::size_t n = 0; n < flags.blocks.size(); ++n) {
    quincunx::report(progress, double(n) / double(flags.blocks.size()));
    const Classification blocks = classify(block_bounds(cells, flags.blocks[n]), cells, {{{isovalue, isovalue}}});
    report.lines.push_back(measure_clusters(fmt::format("{} at {}, blocks of {}", name, isovalue, flags.blocks[n]), blocks,
                                            flags.max_cluster, flags.rounds));
  }
}

void measure_generated(const ClusterFlags& flags, ClusterReport& report, ProgressBar& bar) {
  const Progress progress = bar.stage("generated masks");
  const double all = double(flags.sizes.size() * mask_names().size());
  std::size_t done = 0;
  for (const int size : flags.sizes)
    for (const std::string_view name : mask_names()) {
      quincunx::report(progress, double(done++) / all);
      report.lines.push_back(measure_clusters(fmt::format("{}, {}^3", name, size), generated_mask(name, size), flags.max_cluster, flags.rounds));
    }
}

void cluster(const ClusterFlags& flags) {
  check(flags);
  ProgressBar bar(flags.verbosity);
  ClusterReport report{.max_cluster = flags.max_cluster, .rounds = flags.rounds, .machine = this_machine(""), .lines = {}};
  for (std::size_t n = 0; n < flags.volumes.size(); ++n)
    measure_volume(flags, flags.volumes[n], flags.isovalues[flags.isovalues.size() == 1 ? 0 : n], report, bar);
  if (flags.generated || flags.volumes.empty()) measure_generated(flags, report, bar);
  bar.erase();

  const Table table = cluster_table(report);
  const std::string caption = cluster_caption(report);
  if (!flags.json.empty()) write_text(cluster_json(report).dump(2) + "\n", flags.json);
  fmt::print("{}", flags.markdown ? markdown_text(table) + "\n" + caption + "\n" : caption + "\n\n" + plain_text(table));
}

}  // namespace

Command cluster_command(CLI::App& program) {
  auto flags = std::make_shared<ClusterFlags>();
  CLI::App* app = program.add_subcommand("cluster", "Ways to merge active blocks: their leaves against their time");
  app->footer(
      "Compares cubes (D. Ganter, M. Manzke, 2019) and boxes of any proportions on the blocks of volumes at an isovalue, else on\n"
      "generated ones, and the bounding volume hierarchies over them.");
  app->add_option("VOLUME", flags->volumes, "NRRD files of BCC volumes");
  add_parsed(
      *app, "--iso", [flags](const std::string& text) { flags->isovalues = parse_numbers(text, "--iso"); }, "V[,V...]", "",
      "Isovalue of all volumes, or one for each");
  add_blocks(*app, "--blocks", flags->blocks);
  app->add_flag("--generated", flags->generated, "Generated blocks too; alone where there is no volume");
  add_parsed(
      *app, "--sizes", [flags](const std::string& text) { flags->sizes = parse_integers(text, "--sizes", 1, 512); }, "N[,N...]", "64,256",
      "Edges of the generated masks in blocks");
  add_integer(*app, "--max-cluster", flags->max_cluster, 1, 256, "Largest edge of a cube in blocks");
  add_integer(*app, "--repeat", flags->rounds, 1, 100000, "Rounds");
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { cluster(*flags); }};
}

}  // namespace quincunx

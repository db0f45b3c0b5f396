#include "bench/ranges.h"

#include <fmt/format.h>

#include <memory>

#include "app/flags.h"
#include "app/values.h"
#include "bench/ranges_report.h"
#include "io/atomic_file.h"

namespace quincunx {
namespace {

struct RangesFlags {
  std::vector<int> entries{256, 512, 1024, 2048, 4096, 8192};
  int queries = 1000000, rounds = 20;
  std::string json;
  bool markdown = false;
  Verbosity verbosity = Verbosity::normal;
};

void ranges(const RangesFlags& flags) {
  if (!flags.json.empty()) check_writable(flags.json);
  ProgressBar bar(flags.verbosity);
  const Progress progress = bar.stage("range queries");
  RangesReport report{.rounds = flags.rounds, .machine = this_machine(""), .lines = {}};
  for (std::size_t n = 0; n < flags.entries.size(); ++n) {
    quincunx::report(progress, double(n) / double(flags.entries.size()));
    report.lines.push_back(measure_ranges(flags.entries[n], std::size_t(flags.queries), flags.rounds));
  }
  bar.erase();

  const Table table = ranges_table(report);
  const std::string caption = ranges_caption(report);
  if (!flags.json.empty()) write_text(ranges_json(report).dump(2) + "\n", flags.json);
  fmt::print("{}", flags.markdown ? markdown_text(table) + "\n" + caption + "\n" : caption + "\n\n" + plain_text(table));
}

}  // namespace

Command ranges_command(CLI::App& program) {
  auto flags = std::make_shared<RangesFlags>();
  CLI::App* app = program.add_subcommand("ranges", "Ways to ask whether an interval of values meets one with opacity");
  app->footer("Compares counts of runs with the full table and the iterative range tree of I. Wald (2019) on a made-up transfer function.");
  add_parsed(
      *app, "--entries", [flags](const std::string& text) { flags->entries = parse_integers(text, "--entries", 2, 16384); }, "N[,N...]",
      "256,512,1024,2048,4096,8192", "Entries of the transfer function's table");
  add_integer(*app, "--queries", flags->queries, 1, 100000000, "Intervals that are asked for in each round");
  add_integer(*app, "--repeat", flags->rounds, 1, 100000, "Rounds");
  app->add_flag("--markdown", flags->markdown, "Print the table as Markdown");
  app->add_option("--json", flags->json, "JSON file to write")->type_name("F.json");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { ranges(*flags); }};
}

}  // namespace quincunx

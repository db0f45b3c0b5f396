#include "bench/sweep_preset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "app/flags.h"
#include "bench/gnuplot.h"
#include "bench/output_folder.h"
#include "bench/preset_plot.h"
#include "bench/presets.h"
#include "io/atomic_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// Ctrl-C after some rows were measured and written.
class InterruptedPreset final : public Interrupted {
 public:
  explicit InterruptedPreset(std::size_t rows) : text_(fmt::format("interrupted: {} row{} measured", rows, rows == 1 ? "" : "s")) {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

void write_outputs(const PresetReport& report, const OutputFolder& folder) {
  const std::string name(report.preset->name);
  write_text(preset_csv(report), folder.file(name + ".csv"));
  write_text(preset_json(report).dump(2) + "\n", folder.file(name + ".json"));
  write_text(preset_markdown(report), folder.file(name + ".md"));
  if (!report.panels.empty()) draw_or_note(preset_plot_script(report), folder.file(name + ".svg"));
}

}  // namespace

void add_preset_flags(CLI::App& app, PresetFlags& flags) {
  add_choice_name(app, "--preset", flags.name, preset_names(), "A published experiment instead, on generated volumes or on those given, --iso their least values with opacity");
  app.add_flag("--full", flags.full, "Of --preset: large volumes and pictures; else minutes on two cores");
  app.add_flag("--list-presets", flags.list, "Say what the presets are");
}

void check_preset_flags(const CLI::App& app, const PresetFlags& flags) {
  if (flags.name.empty()) {
    if (flags.full) throw InputError("--full: found no --preset, expected one that it is of");
    return;
  }
  const std::vector<std::string> free{"VOLUME", "--iso", "--spline", "--device", "--json", "--output", "--quiet", "--preset", "--full", "--help"};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front();
    if (option->count() == 0 || std::find(free.begin(), free.end(), name) != free.end()) continue;
    throw InputError(fmt::format("{}: found with --preset {}, which fixes it; expected none, or the sweep of a volume without --preset", name, flags.name));
  }
}

void list_presets() {
  for (const Preset& preset : presets()) fmt::print("{:<16} {}\n{:<16} {}\n", preset.name, preset.shows, "", preset.paper);
}

void sweep_preset(const PresetFlags& flags, const PresetWishes& wishes, const std::string& path, bool json, Verbosity verbosity) {
  OutputFolder folder(path);
  ProgressBar bar(verbosity);
  PresetRun run(wishes, bar);
  run.check(preset_of(flags.name));
  folder.prepare({flags.name + ".csv", flags.name + ".json", flags.name + ".md", flags.name + ".svg"});
  const bool whole = run_preset(flags.name, run);
  bar.erase();
  PresetReport& report = run.report();
  report.full = flags.full;
  write_outputs(report, folder);
  if (json) {
    fmt::print("{}\n", preset_json(report).dump(2));
  } else if (verbosity == Verbosity::normal) {
    fmt::print("{}", preset_text(report));
  }
  if (!whole) throw InterruptedPreset(report.rows.size());
  if (!report.differing.empty()) throw std::runtime_error(preset_pictures(report));
}

}  // namespace quincunx

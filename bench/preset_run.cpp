#include "bench/preset_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "accel/structure.h"
#include "app/volume_input.h"
#include "bench/open_device.h"
#include "bench/presets.h"
#include "bench/views.h"
#include "lattice/error.h"
#include "render/device_renderer.h"

namespace quincunx {
namespace {

/// Opacity grows over half of what is above the threshold.
PresetVolume read_preset_volume(const std::string& path, double threshold, const Progress& progress) {
  PresetVolume read{.name = std::filesystem::path(path).stem().string(), .volume = read_finite_volume(path, progress), .threshold = threshold, .soft = 1.0};
  const SampleRange range = sample_range(read.volume);
  if (!(threshold >= range.min && threshold < range.max))
    throw InputError(fmt::format("--iso: found {} for {}, expected a value within its samples' range, from {} to less than {}", threshold, path, range.min, range.max));
  read.soft = 0.5 * (range.max - threshold);
  return read;
}

std::string frames_text(const PresetSize& size) {
  return fmt::format("{} x {} pixels, {} view{} of an orbit, {} round{}, blocks of {} cells, no cell test, unlit, steps of 1 cell.", size.width, size.height, size.views,
                     size.views == 1 ? "" : "s", size.rounds, size.rounds == 1 ? "" : "s", size.block);
}

}  // namespace

PresetSize PresetSize::full() {
  return {.cells = 512, .block = 8, .cluster_cells = 512, .cluster_blocks = {2, 4, 8}, .width = 1024, .height = 1024, .views = 16, .rounds = 3, .cluster_rounds = 3};
}

void PresetRun::check(const Preset& preset) const {
  const std::size_t volumes = wishes_.volumes.size(), found = wishes_.thresholds.size();
  if (volumes > 0 && !preset.takes_volumes)
    throw InputError(fmt::format("VOLUME: found {} with --preset {}, expected none: it makes its own", wishes_.volumes.front(), preset.name));
  if (volumes == 0 && found > 0) throw InputError("--iso: found no volume, expected one that it is of");
  if (volumes > 0 && found != 1 && found != volumes)
    throw InputError(fmt::format("--iso: found {} value{} for {} volume{}, expected one for all or one for each: with --preset, the value from which on there is opacity", found,
                                 found == 1 ? "" : "s", volumes, volumes == 1 ? "" : "s"));
}

std::vector<PresetSource> PresetRun::sources(std::initializer_list<std::string_view> generated, int cells) {
  std::vector<PresetSource> all;
  for (std::size_t n = 0; n < wishes_.volumes.size(); ++n) {
    const std::string path = wishes_.volumes[n];
    const double threshold = wishes_.thresholds.at(wishes_.thresholds.size() == 1 ? 0 : n);
    all.push_back({std::filesystem::path(path).stem().string(), [path, threshold](const Progress& progress) { return read_preset_volume(path, threshold, progress); }});
  }
  if (!all.empty()) return all;
  const LatticeKind lattice = generated_lattice();
  report_.notes.push_back(fmt::format("Volumes are generated, {} cells along an axis.", cells));
  for (const std::string_view name : generated)
    all.push_back({std::string(name), [name, lattice, cells](const Progress& progress) { return generated_volume(name, lattice, cells, progress); }});
  return all;
}

PresetVolume PresetRun::balls(int count, double radius) const { return generated_balls(count, radius, generated_lattice(), size().cells); }

LatticeKind PresetRun::generated_lattice() const { return wishes_.spline.empty() ? LatticeKind::cartesian : make_spline(wishes_.spline)->lattice(); }

std::vector<std::string> PresetRun::known(std::initializer_list<std::string_view> labels) {
  std::vector<std::string> found;
  const auto has = [](const auto& list, std::string_view label) { return std::find(list.begin(), list.end(), label) != list.end(); };
  for (const std::string_view label : labels) {
    if (!has(skip_labels(), label)) {
      report_.notes.push_back(fmt::format("There is no {} here to measure.", label));
    } else if (has(wishes_.labels, label)) {
      found.emplace_back(label);
    }
  }
  return found;
}

CellBounds PresetRun::bounds(const PresetVolume& volume) {
  const auto spline = make_spline(wishes_.spline, volume.volume.lattice);
  const auto coefficients = spline->coefficients_float(volume.volume, Spline::Prefilter::automatic, {}, bar_.stage(volume.name + ", prefilter"));
  return cell_bounds(*spline, coefficients, bar_.stage(volume.name + ", bounds"));
}

std::unique_ptr<Renderer> PresetRun::renderer(const PresetVolume& volume) {
  if (!kernels_) kernels_ = std::make_shared<KernelCache>(open_device(wishes_.device));
  Renderer::Config config;
  config.spline = make_spline(wishes_.spline, volume.volume.lattice)->name();
  return std::make_unique<DeviceRenderer>(kernels_, volume.volume, config);
}

void PresetRun::sweep(Renderer& renderer, const PresetVolume& volume, const DirectVolume& look, std::span<const std::string> labels, const Row& row) {
  Renderer::Request request;
  request.scene.volume = look;
  request.scene.width = size().width;
  request.scene.height = size().height;
  const SweepChoices choices{.labels = {labels.begin(), labels.end()}, .blocks = {size().block}, .cell_tests = CellTests::off};
  SweepPlan plan{.settings = sweep_settings(choices, {}), .views = orbit_views(request, volume.volume, size().views), .rounds = size().rounds};
  plan.moved = 1e-3 * volume.soft;
  std::vector<SweepMeasurement> measured;
  const auto take = [&] {
    for (std::size_t n = 0; n < measured.size(); ++n) {
      report_.machine.device = measured[n].scene.device;
      if (n > 0) ++report_.compared;
      if (measured[n].differing_pixels > 0)
        report_.differing.push_back(fmt::format("{}, {}: {} pixels", volume.name, plan.settings[n].label(), measured[n].differing_pixels));
      row(plan.settings[n], measured[n], measured.front());
    }
  };
  try {
    measure_sweep(renderer, plan, measured, bar_.stage(volume.name));
  } catch (const Interrupted&) {
    take();
    throw;
  }
  take();
}

DirectVolume preset_look(const PresetVolume& volume, double opacity) {
  const double low = volume.threshold, high = volume.threshold + volume.soft;
  DirectVolume look;
  look.function = {.colors = {{low, {0.1, 0.2, 0.6}}, {high, {1.0, 0.8, 0.5}}}, .opacities = {{low, 0.0}, {high, opacity}}, .unit = 0.0};
  look.shade = false;
  return look;
}

std::string preset_extents(const Volume& volume) {
  const Extents& n = volume.extents;
  return fmt::format("{} x {} x {}{}", n.x, n.y, n.z, volume.lattice == LatticeKind::bcc ? " x 2" : "");
}

bool run_preset(std::string_view name, PresetRun& run) {
  const Preset& preset = preset_of(name);
  run.check(preset);
  PresetReport& report = run.report();
  report.preset = &preset;
  try {
    preset.measure(run);
  } catch (const Interrupted&) {
    if (report.rows.empty()) throw;
    report.whole = false;
  }
  report.machine = this_machine(report.machine.device);
  if (!report.machine.device.empty()) report.setup = frames_text(run.size());
  return report.whole;
}

}  // namespace quincunx

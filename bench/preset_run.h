// What the presets of `quincunx sweep` share: data sets, their renderers, frames in turns.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "accel/bounds.h"
#include "app/progress_bar.h"
#include "bench/preset_report.h"
#include "bench/preset_volumes.h"
#include "bench/sweep_measure.h"
#include "render/kernel_cache.h"
#include "render/renderer.h"

namespace quincunx {

/// How much is measured.
struct PresetSize {
  int cells = 128;                   ///< along an axis of generated volumes that are rendered
  int block = 4;                     ///< cells: edge of the structures' blocks there
  int cluster_cells = 256;           ///< along an axis of those whose blocks are clustered alone
  std::vector<int> cluster_blocks{4, 8, 16};  ///< edges of their blocks in cells, ascending
  int width = 256, height = 256;
  int views = 4, rounds = 3;         ///< of an orbit; of its timed frames
  int cluster_rounds = 3;            ///< of clustering and building

  /// Of `--full`: 64^3 and 256^3 blocks to cluster, as in D. Ganter and M. Manzke's Table 1; volumes of 512^3 cells.
  static PresetSize full();
};

/// What is asked for.
struct PresetWishes {
  std::vector<std::string> volumes;     ///< files that take the place of generated volumes
  std::vector<double> thresholds;       ///< of these: one for all, or one for each
  std::string spline;                   ///< a name of spline_names(); empty: trilinear for generated volumes, default_spline of a file's lattice
  std::string device;
  PresetSize size;
  std::vector<std::string> labels;      ///< of skip_labels(): no others are measured
};

/// Where a data set comes from.
struct PresetSource {
  std::string name;
  std::function<PresetVolume(const Progress&)> make;
};

class PresetRun {
 public:
  PresetRun(const PresetWishes& wishes, ProgressBar& bar) : wishes_(wishes), bar_(bar) {}

  const PresetSize& size() const { return wishes_.size; }
  PresetReport& report() { return report_; }
  ProgressBar& bar() { return bar_; }

  /// Throws InputError where files were named that `preset` does not take, or without the values that they need.
  void check(const Preset& preset) const;

  /// The files that are asked for, else generated volumes of these names, of `cells` cells along an axis.
  std::vector<PresetSource> sources(std::initializer_list<std::string_view> generated, int cells);
  PresetVolume balls(int count, double radius) const;
  /// Those of `labels` that are of skip_labels() and are asked for; a note where one is no way to skip of this program.
  std::vector<std::string> known(std::initializer_list<std::string_view> labels);
  /// Bounds of all cells, for what needs no renderer.
  CellBounds bounds(const PresetVolume& volume);

  std::unique_ptr<Renderer> renderer(const PresetVolume& volume);
  /// Called with each setting, what it cost, and what none did.
  using Row = std::function<void(const SweepSetting& setting, const SweepMeasurement& measured, const SweepMeasurement& none)>;
  /// Measures none and each label with blocks of size().block cells and without cell tests, so that structures alone skip (as published), from
  /// an orbit about the volume; compares the pictures. Interrupted, it calls `row` for the settings that are complete and lets that through.
  void sweep(Renderer& renderer, const PresetVolume& volume, const DirectVolume& look, std::span<const std::string> labels, const Row& row);

 private:
  LatticeKind generated_lattice() const;

  const PresetWishes& wishes_;
  ProgressBar& bar_;
  PresetReport report_;
  std::shared_ptr<KernelCache> kernels_;  ///< once something is rendered
};

/// A volume without light, in steps of a cell: no opacity below the threshold, `opacity` from volume.soft above it on.
DirectVolume preset_look(const PresetVolume& volume, double opacity);

/// The size of a volume's lattice: "129 x 129 x 129", "64 x 64 x 64 x 2".
std::string preset_extents(const Volume& volume);

/// Runs the named preset; false where it was interrupted after some rows. Throws InputError, naming VOLUME or --iso, for files that it does not take, or
/// for other numbers of them than of values.
bool run_preset(std::string_view name, PresetRun& run);

}  // namespace quincunx

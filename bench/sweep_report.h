// What `quincunx sweep` tells.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/sweep_bricks.h"
#include "bench/sweep_measure.h"
#include "bench/table.h"

namespace quincunx {

/// A whole run.
struct SweepReport {
  std::string volume;
  std::string spline;  ///< a name of spline_names()
  std::vector<double> isovalues;
  std::string transfer_function;     ///< its file; empty where only isosurfaces are seen
  std::optional<DirectVolume> look;  ///< how the volume is seen through it
  int width = 0, height = 0, views = 0, rounds = 0;
  Intersect intersect = Intersect::exact;
  double step = 0.0;  ///< of march, in cells
  Precision precision = Precision::float32;
  Storage storage = Storage::float32;  ///< of coefficients, where precision is float32
  SweepChoices choices;
  Machine machine;
  std::vector<SweepSetting> settings;      ///< as they were planned; the first one is none
  std::vector<SweepMeasurement> measured;  ///< of the first of them, at least one; of fewer than there are after Ctrl-C
  std::vector<BricksMeasurement> bricks;   ///< none where no brick size was asked for

  /// Of the frames of a setting.
  double median_ms(std::size_t setting) const;
  /// Number of the setting with the least median frame time.
  std::size_t best() const;
  /// How many times as fast as none: frames of the same round and view.
  Spread speedup_of(std::size_t setting) const;
  /// The settings and bricks whose pictures differ from those that all must be: "grid, 8: 12 pixels". There should be none.
  std::vector<std::string> differing() const;
};

/// "isovalues 1.5, 2" or "transfer function head.json", or both.
std::string sweep_subject(const SweepReport& report);
/// "exact" or "march 0.25", "post, steps of 1 cell", or both, and whether in 64-bit floats, or with coefficients of 16 or 8 bits.
std::string sweep_method(const SweepReport& report);

/// What was measured where, and what the marks mean, in sentences.
std::string sweep_caption(const SweepReport& report);
/// One row a structure, one column a block size: median frame times. In the form of M. Kim's Table 4 (spline/bcc7.h).
Table sweep_frame_table(const SweepReport& report);
/// One row a setting: blocks, leaves, stages, times. In the form of Table 1 of D. Ganter, M. Manzke, "An analysis of region
/// clustered BVH volume rendering on GPU", Computer Graphics Forum 38(8), 2019, doi:10.1111/cgf.13756.
Table sweep_stage_table(const SweepReport& report);
/// One row a size of brick, the whole volume first.
Table sweep_bricks_table(const SweepReport& report);
/// How many pictures were compared, and whether all were the same.
std::string sweep_pictures(const SweepReport& report);
/// What `--skip auto` chose, and how far it is from the best.
std::string sweep_choice(const SweepReport& report);

/// docs/performance.md names the keys.
nlohmann::ordered_json sweep_json(const SweepReport& report);
/// A line of keys and one line for each setting that was measured, the numbers those of sweep_json.
std::string sweep_csv(const SweepReport& report);
/// Caption, tables and choice.
std::string sweep_markdown(const SweepReport& report);
std::string sweep_text(const SweepReport& report);

}  // namespace quincunx

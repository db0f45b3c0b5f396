// The experiments of publications, to be made again by name: `quincunx sweep --preset`.
#pragma once

#include <string_view>
#include <vector>

#include "bench/preset_run.h"

namespace quincunx {

/// A row of the one list.
struct Preset {
  std::string_view name;
  std::string_view paper;      ///< authors, title, year, DOI, table or figure
  std::string_view shows;      ///< half a sentence
  std::string_view published;  ///< what the authors found, as far as it is known here, and what is not; sentences
  bool takes_volumes;          ///< else it is about volumes that it makes
  void (*measure)(PresetRun& run);  ///< fills run.report(), row by row
};

const std::vector<Preset>& presets();
/// The names of presets().
std::vector<std::string> preset_names();
/// Throws InputError naming the choices.
const Preset& preset_of(std::string_view name);

// bench/ganter_presets.cpp
void ganter_table1(PresetRun& run);
void ganter_figure6(PresetRun& run);
void ganter_figure7(PresetRun& run);
void ganter_figure8(PresetRun& run);
void ganter_figure10(PresetRun& run);
// bench/zellmann_presets.cpp
void zellmann_table1(PresetRun& run);
void zellmann_figure3(PresetRun& run);
void zellmann_figure4(PresetRun& run);
void zellmann_figure5(PresetRun& run);
// bench/kinkelin_presets.cpp
void kinkelin_table3(PresetRun& run);

}  // namespace quincunx

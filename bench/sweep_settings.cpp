#include "bench/sweep_settings.h"

#include <algorithm>

#include "accel/structure.h"

namespace quincunx {
namespace {

bool same_way(const SkipConfig& a, const SkipConfig& b) {
  if (skip_label(a) != skip_label(b)) return false;
  if (a.structure == "none") return true;
  const bool cubes = a.structure == "bvh" && a.clustering == Clustering::cubes;
  return a.block == b.block && a.cell_test == b.cell_test && (!cubes || a.max_cluster == b.max_cluster);
}

void add_chosen(std::vector<SweepSetting>& settings, const SkipConfig& chosen) {
  const auto same = [&](const SweepSetting& setting) { return same_way(setting.skip, chosen); };
  const auto place = std::find_if(settings.begin(), settings.end(), same);
  if (place != settings.end()) {
    place->chosen = true;
    return;
  }
  const auto larger = [&](const SweepSetting& setting) { return setting.skips() && setting.skip.block > chosen.block; };
  settings.insert(std::find_if(settings.begin(), settings.end(), larger), {chosen, true});
}

}  // namespace

std::string SweepSetting::label() const { return skip_label(skip); }

std::vector<SweepSetting> sweep_settings(const SweepChoices& choices, const std::optional<SkipConfig>& chosen) {
  SkipConfig none = labelled_skip("none");
  none.block = 1;  // of no meaning there, but any block is a number
  none.cell_test = false;
  std::vector<SweepSetting> settings{{none}};
  for (const int block : choices.blocks) {
    for (const bool cell_test : {true, false}) {
      if (choices.cell_tests == (cell_test ? CellTests::off : CellTests::on)) continue;
      for (const std::string& label : choices.labels) {
        if (label == "none") continue;
        SkipConfig base;
        base.block = block;
        base.cell_test = cell_test;
        settings.push_back({labelled_skip(label, base)});
      }
    }
  }
  if (chosen) add_chosen(settings, *chosen);
  return settings;
}

}  // namespace quincunx

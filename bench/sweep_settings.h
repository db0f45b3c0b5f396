// The ways to skip that a sweep compares.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accel/skip_config.h"

namespace quincunx {

/// One way.
struct SweepSetting {
  SkipConfig skip;      ///< complete: a structure by name, a block size
  bool chosen = false;  ///< by `--skip auto` for this scene

  /// A label of skip_labels().
  std::string label() const;
  bool skips() const { return skip.structure != "none"; }
};

enum class CellTests { on, off, both };

/// What is asked for.
struct SweepChoices {
  std::vector<std::string> labels;           ///< of skip_labels()
  std::vector<int> blocks{2, 4, 8, 16, 32, 64};  ///< ascending
  CellTests cell_tests = CellTests::on;
};

/// `none`, then each label with each block and cell test, and `chosen` where it is not among them: by block, and among
/// those of one block by cell test, so that block bounds are made once and no structure follows itself.
std::vector<SweepSetting> sweep_settings(const SweepChoices& choices, const std::optional<SkipConfig>& chosen);

}  // namespace quincunx

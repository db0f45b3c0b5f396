// The structure and block size for a scene, from what is known before its first frame.
#pragma once

#include <string>

#include "accel/classification.h"
#include "accel/skip_config.h"

namespace quincunx {

/// What the choice depends on beside the blocks.
struct SkipSetting {
  bool cpu = true;      ///< lanes of vector instructions (lavapipe) instead of a GPU's
  bool volume = false;  ///< stretches of a volume are looked at, and no surface
};

struct SkipChoice {
  SkipConfig config;  ///< complete: a structure by name, a block size
  std::string why;    ///< one sentence
};

/// The edge of the blocks, in cells, that choices are made from.
inline constexpr int kChoiceBlock = 8;

/// True where `config` leaves something open: the structure ("auto") or the block size (0).
bool is_open(const SkipConfig& config);

/// Fills in what `wanted` leaves open; docs/performance.md has the measurements behind the rules. `blocks` are of kChoiceBlock cells,
/// classified for the scene; they are not looked at where `wanted` names a structure.
SkipChoice choose_skip(const SkipConfig& wanted, const Classification& blocks, const SkipSetting& setting);

}  // namespace quincunx

// The structure and block size for a scene, from what is known before its first frame.
#pragma once

#include <span>
#include <string>

#include "accel/bounds.h"
#include "accel/skip_config.h"

namespace quincunx {

/// What the choice depends on beside the volume and the isovalues.
struct SkipDevice {
  bool cpu = true;  ///< lanes of vector instructions (lavapipe) instead of a GPU's
};

struct SkipChoice {
  SkipConfig config;  ///< complete: a structure by name, a block size
  std::string why;    ///< one sentence
};

/// True where `config` leaves something open: the structure ("auto") or the block size (0).
bool is_open(const SkipConfig& config);

/// Fills in what `wanted` leaves open; docs/performance.md has the measurements behind the rules. `isovalues` ascend.
SkipChoice choose_skip(const SkipConfig& wanted, const CellBounds& cells, std::span<const double> isovalues, const SkipDevice& device);

}  // namespace quincunx

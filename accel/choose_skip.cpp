#include "accel/choose_skip.h"

#include <fmt/format.h>

#include "accel/classification.h"

namespace quincunx {
namespace {

constexpr int kBlock = 8;           // within a few percent of the best block on every volume measured
constexpr double kCrowded = 0.9;    // from this part of active blocks on there is nothing to leap over

/// What the choice is made from: which blocks of kBlock cells may hold a surface.
struct Crowd {
  std::size_t active = 0, blocks = 0;
  double part() const { return blocks == 0 ? 0.0 : double(active) / double(blocks); }
};

Crowd crowd_of(const CellBounds& cells, std::span<const double> isovalues) {
  const Classification c = classify(block_bounds(cells, kBlock), cells, isovalues);
  return {c.active_blocks, c.level.size()};
}

std::string device_text(const SkipDevice& device) { return device.cpu ? "a CPU's lanes" : "a GPU (not measured yet)"; }

}  // namespace

bool is_open(const SkipConfig& config) { return config.structure == "auto" || config.block == 0; }

SkipChoice choose_skip(const SkipConfig& wanted, const CellBounds& cells, std::span<const double> isovalues, const SkipDevice& device) {
  SkipChoice choice{wanted, ""};
  const bool any_block = wanted.block == 0;
  if (any_block) choice.config.block = kBlock;
  if (wanted.structure != "auto") {
    choice.why = fmt::format("blocks of {} cells are within a few percent of the best for most structures", kBlock);
    return choice;
  }
  const Crowd crowd = crowd_of(cells, isovalues);
  const std::string found = fmt::format("{} of {} blocks of {} cells ({:.1f} %) may hold a surface", crowd.active, crowd.blocks,
                                        kBlock, 100.0 * crowd.part());
  if (crowd.part() >= kCrowded) {
    choice.config.structure = "grid";
    choice.why = found + ": nothing to leap over, and a step of the grid costs least";
  } else {
    choice.config.structure = "distance";
    choice.why = fmt::format("{}: one fetch of the distance map leaps over the rest, the fastest way on {}", found, device_text(device));
  }
  return choice;
}

}  // namespace quincunx

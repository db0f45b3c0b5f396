#include "accel/choose_skip.h"

#include <fmt/format.h>

namespace quincunx {
namespace {

constexpr double kCrowded = 0.9;  // from this part of active blocks on there is nothing to leap over

std::string device_text(const SkipSetting& setting) { return setting.cpu ? "a CPU's lanes" : "a GPU (not measured yet)"; }

}  // namespace

bool is_open(const SkipConfig& config) { return config.structure == "auto" || config.block == 0; }

SkipChoice choose_skip(const SkipConfig& wanted, const Classification& blocks, const SkipSetting& setting) {
  SkipChoice choice{wanted, ""};
  if (wanted.block == 0) choice.config.block = kChoiceBlock;
  if (wanted.structure != "auto") {
    choice.why = fmt::format("blocks of {} cells are within a few percent of the best for most structures", kChoiceBlock);
    return choice;
  }
  const std::size_t count = blocks.level.size();
  const double part = count == 0 ? 0.0 : double(blocks.active_blocks) / double(count);
  const std::string found = fmt::format("{} of {} blocks of {} cells ({:.1f} %) may hold something to be seen", blocks.active_blocks, count,
                                        kChoiceBlock, 100.0 * part);
  if (part >= kCrowded && setting.volume) {
    choice.config.structure = "kdtree";
    choice.config.kd = KdDepth::shallow;
    choice.config.cell_test = false;
    choice.why = found + ": nothing to leap over, and a few large boxes, inside which nothing is asked, cost least";
  } else if (part >= kCrowded) {
    choice.config.structure = "grid";
    choice.why = found + ": nothing to leap over, and a step of the grid costs least";
  } else {
    choice.config.structure = "distance";
    choice.why = fmt::format("{}: one fetch of the distance map leaps over the rest, the fastest way on {}", found, device_text(setting));
  }
  return choice;
}

}  // namespace quincunx

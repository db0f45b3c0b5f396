#include "accel/choose_skip.h"

namespace quincunx {

bool is_open(const SkipConfig& config) { return config.structure == "auto" || config.block == 0; }

SkipChoice choose_skip(const SkipConfig& wanted, const CellBounds&, std::span<const double>, const SkipDevice&) {
  SkipChoice choice{wanted, "the default"};
  if (wanted.structure == "auto") choice.config.structure = "grid";
  if (wanted.block == 0) choice.config.block = 16;
  return choice;
}

}  // namespace quincunx

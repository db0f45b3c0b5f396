#include "render/void_stretches.h"

#include <algorithm>

namespace quincunx {

void VoidStretches::find(const LatticeRay& ray, const glm::ivec3& cells, const VoidCells* voids) {
  stretches_.clear();
  if (!voids || voids->count == 0) return;
  for (CellWalk walk(ray, cells); !walk.done(); walk.advance()) {
    if (!voids->at(walk.cell())) continue;
    if (!stretches_.empty() && stretches_.back().second == walk.enter()) {
      stretches_.back().second = walk.exit();
    } else {
      stretches_.emplace_back(walk.enter(), walk.exit());
    }
  }
}

bool VoidStretches::touch(double a, double b) const {
  // The first stretch that does not end before a.
  const auto at = std::lower_bound(stretches_.begin(), stretches_.end(), a, [](const auto& stretch, double s) { return stretch.second < s; });
  return at != stretches_.end() && at->first <= b;
}

}  // namespace quincunx

// Where a ray is in void cells, in double precision.
#pragma once

#include <utility>
#include <vector>

#include "accel/void_cells.h"
#include "render/ray.h"

namespace quincunx {

class VoidStretches {
 public:
  /// Replaces what was found before. `cells` are those of the volume; `voids` may be null: there are none then.
  void find(const LatticeRay& ray, const glm::ivec3& cells, const VoidCells* voids);

  /// Whether the ray is in a void cell, closed, somewhere in a <= s <= b.
  bool touch(double a, double b) const;

 private:
  std::vector<std::pair<double, double>> stretches_;  ///< s at their ends, ascending
};

}  // namespace quincunx

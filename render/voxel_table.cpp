#include "render/voxel_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quincunx {

double voxel_extinction(const TransferFunction& function, double value, double unit) {
  const double opacity = std::min(function.opacity(value), 1.0 - 0x1p-24);
  return -std::log1p(-opacity) / (function.unit > 0.0 ? function.unit : unit);
}

std::vector<glm::vec4> voxel_table(const TransferFunction& function, const VoxelScale& scale, double unit, double length) {
  std::vector<glm::vec4> table(65536);
  for (std::uint32_t n = 0; n < table.size(); ++n) {
    const double value = scale.density(n);
    table[n] = glm::vec4(glm::dvec4(function.color(value), voxel_extinction(function, value, unit) * length));
  }
  return table;
}

double least_visible(const TransferFunction& function) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto& points = function.opacities;
  const auto seen = std::find_if(points.begin(), points.end(), [](const TransferFunction::OpacityPoint& p) { return p.opacity > 0.0; });
  if (seen == points.end()) return kInfinity;
  if (seen == points.begin()) return -kInfinity;
  return std::nextafter((seen - 1)->value, kInfinity);
}

}  // namespace quincunx

#include "lattice/target_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kSlack = 1e-9;  // of a step: that rounding may have cost

glm::dvec3 domain_of(const Volume& source) { return glm::dvec3(domain_max(source.lattice, source.extents)); }

/// Samples per axis of a domain that is `cells` cells long.
double samples_along(LatticeKind lattice, double cells) { return lattice == LatticeKind::bcc ? 0.5 * (cells + 1.0) : cells + 1.0; }

/// How many samples there would be in all if parts of one counted, with cells `step` times as long as the source's.
double count_of(const glm::dvec3& domain, LatticeKind lattice, double step) {
  double count = coset_count(lattice);
  for (int a = 0; a < 3; ++a) count *= std::max(1.0, samples_along(lattice, domain[a] / step));
  return count;
}

}  // namespace

TargetGrid grid_of_extents(const Volume& source, LatticeKind lattice, const Extents& extents) {
  TargetGrid grid{lattice, extents, source.world};
  const glm::dvec3 from = domain_of(source), to(domain_max(lattice, extents));
  for (int a = 0; a < 3; ++a) {
    if (to[a] > 0.0 && from[a] == 0.0)
      throw InputError(fmt::format("--dims: found {} samples along axis {}, expected 1 and the Cartesian lattice: the volume has no length there", extents[a], a));
    if (to[a] > 0.0) grid.world.axes[a] *= from[a] / to[a];
  }
  return grid;
}

TargetGrid grid_of_spacing(const Volume& source, LatticeKind lattice, double spacing) {
  TargetGrid grid{lattice, Extents(1), source.world};
  const double cell = spacing / lattice_step(lattice);
  const glm::dvec3 domain = domain_of(source);
  for (int a = 0; a < 3; ++a) {
    const double edge = glm::length(source.world.axes[a]), cells = domain[a] * edge / cell;
    const double samples = std::floor(samples_along(lattice, cells) + kSlack);
    if (samples < 1.0)
      throw InputError(fmt::format("--spacing: found {}, expected at most {} for a BCC cell along axis {}", spacing, 2.0 * domain[a] * edge, a));
    grid.extents[a] = std::int64_t(samples);
    grid.world.axes[a] *= cell / edge;
  }
  return grid;
}

TargetGrid grid_of_count(const Volume& source, LatticeKind lattice, std::uint64_t count) {
  const glm::dvec3 domain = domain_of(source);
  double low = 1e-6, high = 1e6;  // steps: too many samples, too few
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (count_of(domain, lattice, middle) > double(count) ? low : high) = middle;
  }
  Extents extents(1);
  for (int a = 0; a < 3; ++a)
    if (domain[a] > 0.0) extents[a] = std::max<std::int64_t>(1, std::llround(samples_along(lattice, domain[a] / high)));
  return grid_of_extents(source, lattice, extents);
}

glm::dvec3 relative_steps(const TargetGrid& grid, const World& source) {
  glm::dvec3 steps;
  for (int a = 0; a < 3; ++a) steps[a] = glm::length(grid.world.axes[a]) / glm::length(source.axes[a]);
  return steps;
}

}  // namespace quincunx

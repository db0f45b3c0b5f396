#include "bench/compare_subject.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lattice/error.h"
#include "render/scene.h"

namespace quincunx {
namespace {

/// Supports and short prefilters of all splines together reach less than four Cartesian steps; interpolation's tail is below 1e-3 there.
constexpr double kBorder = 5.0;
/// Of a Cartesian step, at which a field is looked at along a ray.
constexpr double kFieldStep = 1.0 / 16.0;

}  // namespace

const char* density_name(Density density) { return density == Density::equal ? "equal" : "sparse"; }

double bcc_step(Density density) { return density == Density::equal ? std::pow(4.0, -1.0 / 3.0) : std::sqrt(0.5); }

bool CompareSubject::inside(const glm::dvec3& x) const {
  for (const CompareVolume& v : volumes) {
    const glm::dvec3 u = v.volume.world.to_lattice(x), far(domain_max(v.volume.lattice, v.volume.extents));
    for (int a = 0; a < 3; ++a) {
      const double margin = border * cell / glm::length(v.volume.world.axes[a]);
      if (!(u[a] >= margin && u[a] <= far[a] - margin)) return false;
    }
  }
  return true;
}

CompareSubject field_subject(std::unique_ptr<Field> field, int samples, const std::vector<Density>& densities, const Progress& progress) {
  if (samples < 8 || samples > 1024) throw InputError(fmt::format("--samples: found {}, expected an integer from 8 to 1024", samples));
  CompareSubject subject;
  subject.name = field->name();
  subject.isovalue = field->isovalue();
  subject.cell = 2.0 / (samples - 1);
  subject.border = kBorder;
  subject.volumes.push_back({"cartesian", sample_field(*field, LatticeKind::cartesian, Extents(samples), progress)});
  for (const Density density : densities) {
    // The domain is the cube where 2n - 1 steps span it.
    const auto n = std::int64_t(std::lround(0.5 * (2.0 / (bcc_step(density) * subject.cell) + 1.0)));
    subject.volumes.push_back({density == Density::equal ? "bcc" : "bcc sparse", sample_field(*field, LatticeKind::bcc, Extents(n), progress)});
  }
  subject.field = std::move(field);
  subject.truth = field_continuum(*subject.field, kFieldStep * subject.cell);
  return subject;
}

CompareSubject volume_subject(std::string name, Volume volume, double isovalue) {
  CompareSubject subject;
  subject.name = std::move(name);
  subject.isovalue = isovalue;
  subject.cell = cell_length(volume.world);
  std::string kind(lattice_name(volume.lattice));
  subject.volumes.push_back({std::move(kind), std::move(volume)});
  return subject;
}

}  // namespace quincunx

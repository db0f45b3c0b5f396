#include "bench/compare_subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lattice/error.h"
#include "lattice/low_pass.h"
#include "lattice/target_grid.h"
#include "render/scene.h"
#include "spline/spline_samples.h"

namespace quincunx {
namespace {

/// Supports and short prefilters of all splines together reach less than four Cartesian steps; interpolation's tail is below 1e-3 there.
constexpr double kBorder = 5.0;
/// Of a Cartesian step, at which a field is looked at along a ray.
constexpr double kFieldStep = 1.0 / 16.0;

constexpr std::int64_t kLeastReduced = 16;

/// The volume without what the grid cannot hold, on the grid.
Volume reduced(const Volume& volume, const TargetGrid& grid, const Progress& progress) {
  const glm::dvec3 cutoff = glm::min(band_limit(grid.lattice) / relative_steps(grid, volume.world), glm::dvec3(band_limit(volume.lattice)));
  const auto spline = make_spline("tricubic", volume.lattice);
  return spline_samples(*spline, spline->coefficients(low_pass(volume, cutoff, progress), Spline::Prefilter::iir), grid, SampleType::float32, progress);
}

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

CompareSubject reduced_subject(std::string name, const Volume& volume, double isovalue, double reduce, const std::vector<Density>& densities, const Progress& progress) {
  if (volume.lattice != LatticeKind::cartesian) throw InputError(fmt::format("--reduce: found {} on the bcc lattice, expected a Cartesian volume", name));
  const Extents extents = glm::i64vec3(glm::round(glm::dvec3(volume.extents - std::int64_t(1)) / reduce)) + std::int64_t(1);
  if (std::min(extents.x, std::min(extents.y, extents.z)) < kLeastReduced)
    throw InputError(fmt::format("--reduce: found {}, which leaves {} x {} x {} samples, expected at least {} along each axis", reduce, extents.x, extents.y, extents.z, kLeastReduced));
  CompareSubject subject;
  subject.name = std::move(name);
  subject.isovalue = isovalue;
  subject.border = kBorder;
  subject.truth = spline_continuum(volume, "tricubic", Spline::Prefilter::iir, progress);
  const TargetGrid cartesian = grid_of_extents(volume, LatticeKind::cartesian, extents);
  const std::uint64_t count = std::uint64_t(extents.x * extents.y * extents.z);
  subject.cell = cell_length(cartesian.world);
  subject.volumes.push_back({"cartesian", reduced(volume, cartesian, progress)});
  for (const Density density : densities) {
    const TargetGrid bcc = grid_of_count(volume, LatticeKind::bcc, density == Density::equal ? count : std::uint64_t(double(count) * std::sqrt(0.5)));
    subject.volumes.push_back({density == Density::equal ? "bcc" : "bcc sparse", reduced(volume, bcc, progress)});
  }
  subject.made = fmt::format("made of {} x {} x {} samples by the tricubic spline after a low-pass", volume.extents.x, volume.extents.y, volume.extents.z);
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

#include "app/voxel_input.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "accel/particles.h"
#include "accel/volume_voxels.h"
#include "app/interrupt.h"
#include "app/points_file.h"
#include "app/volume_input.h"
#include "lattice/error.h"
#include "lattice/memory.h"
#include "lattice/stopwatch.h"
#include "render/voxel_table.h"
#include "spline/spline_samples.h"

namespace quincunx {
namespace {

/// So many times the samples per axis, by the spline; the domain stays the same.
Volume supersampled(const RenderFlags& flags, const Volume& volume, ProgressBar& bar) {
  const std::string_view usual = volume.lattice == LatticeKind::bcc ? "bcc7" : "tricubic";
  const auto spline = make_spline(flags.config.spline.empty() ? usual : std::string_view(flags.config.spline), volume.lattice);
  spline->filter(flags.config.prefilter);
  const glm::dvec3 cells = flags.voxel.supersample * glm::dvec3(domain_max(volume.lattice, volume.extents));
  const Extents extents = volume.lattice == LatticeKind::bcc ? Extents(glm::round(0.5 * (cells + 1.0))) : Extents(glm::round(cells)) + std::int64_t(1);
  const TargetGrid grid = grid_of_extents(volume, volume.lattice, extents);
  check_fits_memory(checked_sample_count(grid.lattice, grid.extents, SampleType::float32, "--supersample") * sizeof(float), "--supersample");
  const Coefficients<double> coefficients = spline->coefficients(volume, flags.config.prefilter, bar.stage("prefilter"));
  return spline_samples(*spline, coefficients, grid, SampleType::float32, bar.stage("resampling"));
}

VoxelInput volume_input(const RenderFlags& flags, ProgressBar& bar) {
  VoxelInput input;
  const Stopwatch reading;
  input.volume = read_finite_volume(flags.volume, bar.stage("reading"), flags.config.nan);
  if (flags.config.nan.kind == NanPolicy::Kind::fill) fill_not_finite(input.volume, flags.config.nan.value);
  input.read_ms = reading.ms();

  const TransferFunction function = read_transfer_function(flags.look.transfer_function);
  const VoxelConfig config{flags.voxel.minimum.value_or(least_visible(function)), flags.voxel.deviation};
  if (flags.voxel.supersample == 1.0) {
    const Stopwatch making;
    input.voxels = volume_voxels(input.volume, config, bar.stage("voxels"));
    input.voxels_ms = making.ms();
    return input;
  }
  if (flags.config.nan.kind == NanPolicy::Kind::empty && sample_range(input.volume).not_finite > 0)
    throw InputError("--nan: found empty with --supersample for samples that are not finite, expected fill=V: a spline of them is resampled");
  const Stopwatch resampling;
  const Volume finer = supersampled(flags, input.volume, bar);
  input.resample_ms = resampling.ms();
  const Stopwatch making;
  input.voxels = volume_voxels(finer, config, bar.stage("voxels"));
  input.voxels_ms = making.ms();
  // Opacities are those of the volume's own cells, and its own type holds as many samples.
  input.voxels.unit = cell_length(input.volume.world);
  input.voxels.sample_bytes = input.voxels.samples * sample_type_bytes(input.volume.type());
  return input;
}

VoxelInput particle_input(const RenderFlags& flags) {
  const std::string& path = flags.voxel.particles;
  const double density = read_transfer_function(flags.look.transfer_function).high();
  const Stopwatch reading;
  std::vector<Particle> particles;
  PointsFile file(path, {"radius", "density"});
  while (const auto point = file.next()) {
    if (particles.size() % 65536 == 0) stop_if_interrupted();
    const std::optional<double> radius = file.column(0);
    if (radius && flags.voxel.radius) throw InputError(fmt::format("--radius: found with {}, which has a column radius; expected one of both", path));
    if (!radius && !flags.voxel.radius) throw InputError(fmt::format("{}: found no column radius, expected the header x,y,z,radius or --radius R", path));
    particles.push_back({*point, radius ? *radius : *flags.voxel.radius, file.column(1).value_or(density)});
  }
  VoxelInput input;
  input.read_ms = reading.ms();
  const Stopwatch making;
  input.voxels = particle_voxels(particles, path);
  input.voxels_ms = making.ms();
  input.volume.lattice = input.voxels.lattice, input.volume.extents = input.voxels.extents, input.volume.world = input.voxels.world;
  return input;
}

}  // namespace

VoxelInput read_voxels(const RenderFlags& flags, ProgressBar& bar) { return flags.voxel.particles.empty() ? volume_input(flags, bar) : particle_input(flags); }

}  // namespace quincunx

// Error and time of the combinations, measured in one run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/compare_settings.h"
#include "bench/compare_subject.h"
#include "bench/frame_error.h"
#include "bench/views.h"
#include "lattice/progress.h"
#include "render/kernel_cache.h"

namespace quincunx {

/// Of a spline's values and gradients at random points inside the domain, against the truth.
struct VolumeErrors {
  double value_rmse = 0.0, value_max = 0.0;
  double gradient_rmse = 0.0;                ///< of the vector, per world unit
  double angle_rms = 0.0, angle_p99 = 0.0;   ///< degrees, between the gradients
};

/// What one combination costs, and what it gets wrong.
struct CompareLine {
  CompareSetting setting;
  std::vector<double> frame_ms;   ///< number round * views + view
  FrameErrors reference;          ///< first hits against the double-precision reference of the same spline: errors of intersection
  std::optional<FrameErrors> truth;    ///< against what was sampled, where that is known: all errors together, in CompareSubject::cell
  std::optional<VolumeErrors> volume;  ///< likewise: of reconstruction alone
  double image_rmse = 0.0;        ///< of the pictures against those of the truth, or of the reference where it is not known; means over the views
  double ssim = 0.0;
  std::uint64_t left_out = 0;     ///< pixels of all views in which the hit, or the true one, is too near the border to be compared with the truth
  std::uint64_t coefficient_bytes = 0;
  Frame picture;                  ///< of the first view
};

struct ComparePlan {
  std::vector<CompareSetting> settings;
  int width = 256, height = 256, views = 1, rounds = 5;
  Orbit first = kFirstView;  ///< view
  int points = 20000;      ///< random ones, where values and gradients are compared
  std::uint32_t seed = 1;  ///< of these
};

struct CompareMeasurement {
  std::vector<CompareLine> lines;  ///< one a setting
  std::optional<Frame> truth;      ///< the picture of the first view, where it is known
  std::vector<Frame> references;   ///< likewise, of each line: of the reference of its spline
  std::string device;
};

/// Renders every setting from every view once untimed, then `rounds` times timed; the settings take turns frame by frame.
CompareMeasurement measure_compare(const CompareSubject& subject, const ComparePlan& plan, const std::shared_ptr<KernelCache>& kernels, const Progress& progress = {});

/// Values and gradients of a setting's reconstruction, in double precision, against the truth.
VolumeErrors volume_errors(const CompareSubject& subject, const CompareSetting& setting, const Spline& spline, const Coefficients<double>& coefficients,
                           int points, std::uint32_t seed);

}  // namespace quincunx

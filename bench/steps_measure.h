// Volume rendering of a field whose integral along every ray is known in closed form.
#pragma once

#include <string>
#include <vector>

#include "bench/timing.h"
#include "lattice/progress.h"
#include "render/renderer.h"

namespace quincunx {

/// The field is `sphere` (lattice/field.h), v = 0.64 - |x|^2: a quadratic, which bcc7 and tricubic with their prefilters are exactly, away from
/// the border. The opacity of `unit` = 0.5 goes from 0 at v = 0 to `opacity` at v = 0.64, one colour, unlit: alpha of a pixel is 1 - T,
///   ln T = (1/unit) times the integral of ln(1 - opacity v / 0.64) along the ray,
/// along which v = S^2 - s^2 for -S <= s <= S. With k = opacity / 0.64 and A = 1 - k S^2 that integral is
///   2 times the antiderivative s ln(A + k s^2) - 2 s + 2 sqrt(A/k) atan(s sqrt(k/A)) at s = S, where the logarithm is 0.
struct SphereLook {
  static constexpr double kRadius = 0.8, kUnit = 0.5, kOpacity = 0.9;

  static DirectVolume volume(Classify classify, double step);
  /// Alpha of a ray that passes the sphere's centre at `distance` >= 0.
  static double alpha(double distance);
};

/// What is to be measured.
struct StepsPlan {
  std::vector<std::string> splines{"bcc7", "tricubic", "trilinear"};
  int cells = 96;                ///< along each axis, or one less: samples are chosen so
  std::vector<double> steps{3.2, 1.6, 0.8, 0.4, 0.2, 0.1};  ///< cells, descending
  int size = 256;                ///< pixels each way
  int rounds = 3;                ///< timed frames
  std::string device;            ///< as make_renderer takes it; cpu too
};

/// One spline with one step.
struct StepLine {
  std::string spline;
  double step = 0.0;
  struct Way {
    double rms = 0.0, largest = 0.0;  ///< of alpha, over the pixels whose ray meets the sphere
    std::vector<double> frame_ms;
  };
  Way post, pre_integrated;
};

/// Renders each spline's volume with each step and classification, in turns within a round. `device`: its name.
std::vector<StepLine> measure_steps(const StepsPlan& plan, std::string& device, const Progress& progress = {});

}  // namespace quincunx

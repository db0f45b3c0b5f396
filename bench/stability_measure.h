// The catalogue of stability, measured: what the device makes of each case, judged by the double-precision spline.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/catalogue.h"
#include "bench/judge.h"
#include "lattice/progress.h"
#include "render/kernel_cache.h"

namespace quincunx {

/// What the kernels' evaluation is off by at random points, in units of e m: e = 2^-24, m the largest coefficient near (local_magnitude).
struct EvaluationError {
  double value = 0.0, gradient = 0.0;                    ///< the largest ones
  double value_allowed = 1.0, gradient_allowed = 1.0;    ///< docs/stability.md
  bool passed() const { return value <= value_allowed && gradient <= gradient_allowed; }
};

/// One case with one spline.
struct StabilityLine {
  std::string group, name, spline;
  double isovalue = 0.0;
  EvaluationError evaluation;
  Verdict exact, march;  ///< of all views; march, at `step` cells, for comparison alone
  Verdict doubles;       ///< of kernels that compute in 64-bit floats; no rays where the device has none
  std::optional<bool> refused;  ///< of a case that is to be refused, and nothing else: whether it was, with the place of the first sample

  bool passed() const { return refused ? *refused : evaluation.passed() && exact.passed() && doubles.passed(); }
  bool marched() const { return march.rays > 0; }
  bool doubled() const { return doubles.rays > 0; }
};

struct StabilityPlan {
  std::vector<StabilityCase> cases;
  std::vector<std::string> splines;
  std::string device;
  double step = 0.25;      ///< of the march, cells
  bool huge = false;       ///< also a volume of more than 2^31 samples (bench/huge_volume.h)
  int points = 2000;       ///< where values are compared
  std::uint32_t seed = 1;  ///< of the points
};

/// Adds a line for each case and spline to `lines` as it is known. `device` becomes the device's name. Throws what rendering throws.
void measure_stability(const StabilityPlan& plan, std::vector<StabilityLine>& lines, std::string& device, const Progress& progress = {});

}  // namespace quincunx

// Errors of values and gradients over several spacings, and the orders that they tell.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/compare_measure.h"
#include "bench/table.h"
#include "lattice/progress.h"

namespace quincunx {

struct ConvergencePlan {
  std::string field = "waves";
  std::vector<std::string> splines;
  std::vector<int> samples{25, 37, 55, 82};  ///< Cartesian ones along each axis, ascending; as many BCC ones in all
  int points = 20000;
  std::uint32_t seed = 1;
};

/// A spline with one of its prefilters.
struct ConvergenceLine {
  std::string spline;
  Spline::Filter filter;
  int space_order = 0;               ///< of its automatic prefilter: what the space of its splines can do
  std::vector<double> steps;         ///< the Cartesian step that has as many samples, world
  std::vector<VolumeErrors> errors;  ///< likewise, one a spacing

  /// The power of the spacing with which `member` falls, between the spacings n - 1 and n.
  double order(double VolumeErrors::*member, std::size_t n) const;
  /// What theory says of gradients: the prefilter's own order, as far as derivatives of the space's splines can, one less than its order.
  int gradient_order() const;
};

std::vector<ConvergenceLine> measure_convergence(const ConvergencePlan& plan, const Progress& progress = {});

Table convergence_table(const ConvergencePlan& plan, const std::vector<ConvergenceLine>& lines);
std::string convergence_caption(const ConvergencePlan& plan);
nlohmann::ordered_json convergence_json(const ConvergencePlan& plan, const std::vector<ConvergenceLine>& lines);

}  // namespace quincunx

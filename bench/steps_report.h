// What `quincunx-bench steps` tells.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/steps_measure.h"
#include "bench/table.h"

namespace quincunx {

/// A whole run.
struct StepsReport {
  StepsPlan plan;
  Machine machine;
  std::vector<StepLine> lines;  ///< at least one
};

/// By which power of the step the error fell from one line to the next, where the spline is the same; 0 where there is none before.
double order_between(const StepLine& before, const StepLine& line, StepLine::Way StepLine::*way);

/// One row a spline and step: errors, their order, times.
Table steps_table(const StepsReport& report);
/// What was measured where, in sentences.
std::string steps_caption(const StepsReport& report);
/// docs/performance.md names the keys.
nlohmann::ordered_json steps_json(const StepsReport& report);

}  // namespace quincunx

// What `quincunx-bench intersect` tells.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/hit_error.h"
#include "bench/machine.h"
#include "bench/table.h"
#include "bench/timing.h"

namespace quincunx {

/// A whole run. `costs` and `errors` are as many as `settings`, errors none at all where they were not measured.
struct IntersectReport {
  std::string volume;
  double isovalue = 0.0;
  int width = 0, height = 0, views = 0, rounds = 0, block = 0;
  Machine machine;
  std::vector<Setting> settings;  ///< among them the published one
  std::vector<Cost> costs;
  std::vector<HitErrors> errors;

  /// The published method's; asserted to be there.
  const Cost& baseline() const;
};

/// One row a setting: time, speed-up, evaluations and, where they were measured, errors.
Table intersect_table(const IntersectReport& report);
/// What was measured where, in sentences.
std::string intersect_caption(const IntersectReport& report);
/// docs/performance.md names the keys.
nlohmann::ordered_json intersect_json(const IntersectReport& report);

}  // namespace quincunx

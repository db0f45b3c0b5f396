// What `quincunx-bench precision` tells.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/hit_error.h"
#include "bench/machine.h"
#include "bench/table.h"
#include "bench/timing.h"
#include "render/precision.h"

namespace quincunx {

/// One precision of a volume.
struct PrecisionLine {
  std::string volume;  ///< its file
  double isovalue = 0.0;
  Precision precision = Precision::float32;
  Cost cost;
  HitErrors errors;
  std::uint64_t device_bytes = 0, coefficient_bytes = 0;
};

/// A whole run.
struct PrecisionReport {
  int width = 0, height = 0, views = 0, rounds = 0;
  Machine machine;
  std::vector<PrecisionLine> lines;  ///< float, then double
};

/// Times of double over those of float, frames of the same round and view: both lines of the report.
Spread times_float(const PrecisionReport& report);

Table precision_table(const PrecisionReport& report);
std::string precision_caption(const PrecisionReport& report);
/// docs/performance.md names the keys.
nlohmann::ordered_json precision_json(const PrecisionReport& report);

}  // namespace quincunx

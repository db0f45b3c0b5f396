// What `quincunx-bench ranges` tells.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/ranges_measure.h"
#include "bench/table.h"

namespace quincunx {

/// A whole run.
struct RangesReport {
  int rounds = 0;
  Machine machine;
  std::vector<RangeLine> lines;  ///< at least one
};

/// One row for each number of entries: medians of the times, bytes.
Table ranges_table(const RangesReport& report);
/// What was measured where, in sentences.
std::string ranges_caption(const RangesReport& report);
/// docs/performance.md names the keys.
nlohmann::ordered_json ranges_json(const RangesReport& report);

}  // namespace quincunx
